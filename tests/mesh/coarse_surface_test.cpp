/// What a coarser surface promises.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "meshreel/mesh/coarse_surface.h"
#include "meshreel/mesh/coarse_to_fine.h"
#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

namespace {

Matrix<double> places_of(const Animation& animation)
{
    Matrix<double> X(animation.vertex_count, 3);
    std::ranges::copy(animation.frame(0), X.values.begin());
    return X;
}

/// About every fourth vertex and so on, as a codec's levels keep them.
std::vector<std::uint32_t> spread_over(const Animation& animation, std::size_t most)
{
    const CoarseToFine order = coarse_to_fine(places_of(animation).view(), 1, {1});
    std::size_t end = 0;
    for (const std::size_t e : order.ends) end = e <= most ? e : end;
    std::vector<std::uint32_t> kept(order.order.begin(), order.order.begin() + static_cast<std::ptrdiff_t>(end));
    std::ranges::sort(kept);
    return kept;
}

CoarseSurface coarse_of(const Animation& animation, std::span<const std::uint32_t> kept)
{
    return coarse_surface(animation.triangles, places_of(animation).view(), kept);
}

Topology topology_of(const Animation& animation, std::size_t most)
{
    const std::vector<std::uint32_t> kept = spread_over(animation, most);
    return describe(static_cast<std::uint32_t>(kept.size()), coarse_of(animation, kept).triangles);
}

} // namespace

TEST(CoarseSurface, OfAClosedManifoldStaysOneAndKeepsItsGenus)
{
    const Animation sphere = *shapes::generate(*shapes::find("jelly"), {.vertices = 4000, .frames = 1});
    const Topology fine = describe(sphere.vertex_count, sphere.triangles);
    ASSERT_TRUE(fine.closed_manifold());
    for (const std::size_t most : {1000u, 250u, 60u}) {
        const Topology coarse = topology_of(sphere, most);
        EXPECT_TRUE(coarse.closed_manifold()) << most;
        EXPECT_EQ(coarse.euler, fine.euler) << most;
        EXPECT_EQ(coarse.isolated_vertices, 0u) << most;
    }
}

TEST(CoarseSurface, OfATorusKeepsItsHandle)
{
    const Topology coarse = topology_of(test_shapes::torus(), 60);
    EXPECT_TRUE(coarse.closed_manifold());
    EXPECT_EQ(coarse.euler, 0);
}

TEST(CoarseSurface, OverAllVerticesIsTheSurfaceItself)
{
    const Animation torus = test_shapes::torus();
    EXPECT_EQ(coarse_of(torus, spread_over(torus, torus.vertex_count)).triangles, torus.triangles);
}

TEST(CoarseSurface, OfWhateverShapeIsValidAndOriented)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        for (std::size_t most = 1; most <= animation.vertex_count; most *= 2) {
            const std::vector<std::uint32_t> kept = spread_over(animation, std::max<std::size_t>(most, 3));
            const CoarseSurface coarse = coarse_of(animation, kept);
            const Topology topology = describe(static_cast<std::uint32_t>(kept.size()), coarse.triangles);
            EXPECT_EQ(topology.degenerate_triangles, 0u) << name;
            EXPECT_TRUE(std::ranges::is_sorted(coarse.triangle_of)) << name;
            EXPECT_EQ(coarse.triangle_of.size(), coarse.triangles.size()) << name;
        }
    }
}

TEST(CoarseSurface, KeepsOneTriangleOnlyIfItKeepsItsCorners)
{
    const Animation triangle = test_shapes::one_triangle();
    const std::vector<std::uint32_t> all{0, 1, 2}, two{0, 2};
    EXPECT_EQ(coarse_of(triangle, all).triangles, triangle.triangles);
    EXPECT_TRUE(coarse_of(triangle, two).triangles.empty());
    EXPECT_TRUE(coarse_of(triangle, {}).triangles.empty());
}

TEST(CoarseSurface, DropsPartsThatKeepNoVertex)
{
    const std::vector<Triangle> two{{0, 1, 2}, {3, 4, 5}};
    const Matrix<double> X(6, 3);
    const std::vector<std::uint32_t> kept{3, 4, 5};
    const CoarseSurface coarse = coarse_surface(two, X.view(), kept);
    ASSERT_EQ(coarse.triangles.size(), 1u);
    EXPECT_EQ(coarse.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(coarse.triangle_of[0], 1u);
}

TEST(CoarseSurface, GivesAVertexBetweenTwoToTheFirst)
{
    // 0 - 1 - 2 in a row, and triangles on it whose third corners are kept: 1 joins 0, so one triangle stays
    const std::vector<Triangle> triangles{{0, 1, 3}, {1, 2, 3}};
    Matrix<double> X(4, 3);
    X.values = {0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 5, 0};
    const std::vector<std::uint32_t> kept{0, 2, 3};
    const CoarseSurface coarse = coarse_surface(triangles, X.view(), kept);
    ASSERT_EQ(coarse.triangle_of, std::vector<std::uint32_t>{1});
    EXPECT_EQ(coarse.triangles[0], (Triangle{0, 1, 2}));
}

TEST(CoarseSurface, SurvivesPlacesFarOutside)
{
    const Animation torus = test_shapes::torus();
    Matrix<double> X = places_of(torus);
    for (std::size_t i = 0; i < X.values.size(); i += 7) X.values[i] = 1e30;
    const std::vector<std::uint32_t> kept{1, 5, 9, 30, 60};
    EXPECT_LE(coarse_surface(torus.triangles, X.view(), kept).triangles.size(), torus.triangles.size());
}
