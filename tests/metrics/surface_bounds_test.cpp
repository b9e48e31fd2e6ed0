/// What the bounds of a one-sided distance promise.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/metrics/surfaces.h"

using namespace meshreel;
using namespace meshreel::metrics;
using namespace meshreel::metrics::test;

namespace {

/// The largest distance found at every 1/n-th of the way along both sides of each triangle.
double dense_distance(const Surface& from, const Surface& to, int n)
{
    double most = 0;
    for (const auto& [i, j, k] : from.triangles)
        for (int u = 0; u <= n; ++u)
            for (int v = 0; v <= n - u; ++v) {
                const Point a = from.vertex(i), ab = minus(from.vertex(j), a), ac = minus(from.vertex(k), a);
                most = std::max(
                    most, no_tree_distance(plus(a, plus(times(double(u) / n, ab), times(double(v) / n, ac))), to));
            }
    return most;
}

Surface single(std::vector<float> positions)
{
    return {{{0, 1, 2}}, std::move(positions)};
}

} // namespace

TEST(SurfaceBounds, OfParallelSquaresAreTheirGapHoweverTheyAreCutIntoTriangles)
{
    for (std::uint32_t n : {1u, 3u, 7u}) {
        const DistanceBounds found = bounds(square(4, 0), square(n, 0.25f), {.tolerance = 1e-9});
        EXPECT_DOUBLE_EQ(found.lower, 0.25);
        EXPECT_NEAR(found.upper, 0.25, 1e-9);
    }
}

TEST(SurfaceBounds, OfASphereInsideAnotherAreTheDifferenceOfTheRadii)
{
    const DistanceBounds found = bounds(sphere(48, 1), sphere(48, 1.5), {.tolerance = 1e-7});
    EXPECT_LE(found.upper - found.lower, 1e-7);
    EXPECT_NEAR(found.lower, 0.5, 0.5 * (1 - std::cos(M_PI / 48)));
}

TEST(SurfaceBounds, OfATriangleToAPointAreTheFarthestCorner)
{
    const DistanceBounds found = bounds(single({0, 0, 3, 4, 0, 3, 0, 12, 3}), single({0, 0, 0, 0, 0, 0, 0, 0, 0}), {});
    EXPECT_DOUBLE_EQ(found.lower, std::sqrt(153.0));
    EXPECT_DOUBLE_EQ(found.upper, std::sqrt(153.0));
}

TEST(SurfaceBounds, FindTheFarthestPointWhereNoVertexIs)
{
    const Surface roof{{{0, 1, 2}, {3, 4, 5}}, {-4, -1, 0, -4, 1, 0, -1, 0, 0, 4, -1, 0, 4, 1, 0, 1, 0, 0}};
    const DistanceBounds found = bounds(single({-4, 0, 0, 4, 0, 0, 4, 0, 0}), roof, {.tolerance = 1e-9});
    EXPECT_NEAR(found.lower, 1, 1e-9); // between the tips
    EXPECT_NEAR(found.upper, 1, 1e-9);
}

TEST(SurfaceBounds, ContainWhatDenseSamplingFindsAndAreAsTightAsAsked)
{
    for (const auto& [name, shape] : test_shapes::all()) {
        if (shape.triangles.empty() || shape.triangles.size() > 300) continue;
        const Surface one = surface_of(shape), two = noisy(one, 0.1);
        const DistanceBounds found = bounds(one, two, {.tolerance = 1e-6});
        const double dense = dense_distance(one, two, 8);
        EXPECT_LE(dense, found.upper * (1 + 1e-12)) << name;
        EXPECT_LE(found.upper - found.lower, 1e-6) << name;
        EXPECT_LE(found.lower, dense + 0.1) << name;
    }
}

TEST(SurfaceBounds, AreTrueForSurfacesOfOtherTriangles)
{
    const Surface fine = noisy(sphere(12, 1), 0.03), coarse = noisy(sphere(5, 1), 0.03);
    for (const auto& [from, to] : {std::pair(fine, coarse), std::pair(coarse, fine)}) {
        const DistanceBounds found = bounds(from, to, {.tolerance = 1e-6});
        const double dense = dense_distance(from, to, 16);
        EXPECT_LE(dense, found.upper);
        EXPECT_NEAR(found.lower, dense, 0.005);
        EXPECT_LE(found.upper - found.lower, 1e-6);
    }
}

TEST(SurfaceBounds, AreTrueThoughWiderWhenNoCutIsAllowed)
{
    const Surface fine = noisy(sphere(12, 1), 0.03), coarse = noisy(sphere(5, 1), 0.03);
    const DistanceBounds good = bounds(fine, coarse, {.tolerance = 1e-9}),
                         quick = bounds(fine, coarse, {.tolerance = 1e-9, .most_cuts = 0});
    EXPECT_LE(quick.lower, good.lower);
    EXPECT_GE(quick.upper, good.upper);
    EXPECT_GT(quick.upper - quick.lower, 1e-9);
}

TEST(SurfaceBounds, AreTheSameWithinTheToleranceWhetherOrNotTrianglesHaveCounterparts)
{
    const Surface one = sphere(16, 1), two = noisy(one, 0.05);
    const DistanceBounds found = bounds(one, two, {.tolerance = 1e-8}),
                         hinted = bounds(one, two, {.tolerance = 1e-8, .same_triangles = true});
    EXPECT_NEAR(found.upper, hinted.upper, 2e-8);
    EXPECT_NEAR(found.lower, hinted.lower, 2e-8);
}

TEST(SurfaceBounds, AreExactlyZeroWhereASurfaceLiesOnItself)
{
    for (const auto& [name, shape] : test_shapes::all()) {
        if (shape.triangles.empty()) continue;
        const DistanceBounds found =
            bounds(surface_of(shape), surface_of(shape), {.tolerance = 1e-9, .same_triangles = true});
        EXPECT_EQ(found.lower, 0) << name;
        EXPECT_EQ(found.upper, 0) << name;
    }
}

TEST(SurfaceBounds, GiveEveryVertexItsDistanceAlsoOneThatNoTriangleHas)
{
    Surface one = sphere(8, 1);
    const Surface two = noisy(one, 0.1);
    one.positions.insert(one.positions.end(), {3, 0, 0});
    std::vector<double> distances(one.positions.size() / 3);
    const DistanceBounds found = bounds(one, two, {.tolerance = 1e-6, .vertices = distances});
    for (std::uint32_t v = 0; v < distances.size(); ++v)
        EXPECT_DOUBLE_EQ(distances[v], no_tree_distance(one.vertex(v), two));
    EXPECT_LT(found.upper, distances.back()); // it is no part of the surface
}

TEST(SurfaceBounds, StayTrueForHugeAndTinyModels)
{
    for (double scale : {1e-30, 1e-12, 1e12, 1e30}) {
        const DistanceBounds found = bounds(sphere(8, scale), sphere(8, 2 * scale), {.tolerance = 1e-6 * scale});
        EXPECT_NEAR(found.upper / scale, 1, 0.1) << scale;
        EXPECT_LE(found.upper - found.lower, 1e-6 * scale) << scale;
    }
}
