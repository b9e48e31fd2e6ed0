/// What samples of surfaces promise.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/metrics/surface_samples.h"
#include "tests/metrics/surfaces.h"

using namespace meshreel;
using namespace meshreel::metrics;
using namespace meshreel::metrics::test;

TEST(SurfaceSamples, OfAPlaneOverAnotherAreAllAsFarAway)
{
    const SampledDistance found = sample_faces(square(5, 0).tree(), square(2, 0.5f).tree(), {.count = 5000});
    EXPECT_EQ(found.count, 5000u);
    EXPECT_DOUBLE_EQ(std::sqrt(found.largest), 0.5);
    EXPECT_DOUBLE_EQ(found.rms(), 0.5);
}

TEST(SurfaceSamples, CountByAreaNotByTriangle)
{
    // The unit square against the plane z = 0, itself tilted: z = x, so the mean square is 1/3, fine triangles or not.
    Surface tilted = square(1, 0);
    for (std::size_t i = 0; i < tilted.positions.size(); i += 3) tilted.positions[i + 2] = tilted.positions[i];
    const std::uint32_t corner = 0, v = 4;
    tilted.positions.insert(tilted.positions.end(), {0.01f, 0.01f, 0.01f});
    tilted.triangles = {{corner, 1, v}, {1, 2, v}, {2, corner, v}, {1, 3, 2}}; // slivers near the corner
    const Surface plane{{{0, 1, 2}}, {-9, -9, 0, 20, -9, 0, -9, 20, 0}};
    EXPECT_NEAR(sample_faces(tilted.tree(), plane.tree(), {.count = 40000}).rms(), std::sqrt(1.0 / 3), 4e-3);
}

TEST(SurfaceSamples, OfEdgesAreUniformByLength)
{
    const Surface bent{{{0, 1, 1}}, {0, 0, 0, 0, 0, 1}}; // one edge along z
    const Surface plane{{{0, 1, 2}}, {-9, -9, 0, 20, -9, 0, -9, 20, 0}};
    const SampledDistance found = sample_edges(Outline(bent.triangles), bent.positions, plane.tree(), {.count = 20000});
    EXPECT_NEAR(found.rms(), std::sqrt(1.0 / 3), 1e-2);
    EXPECT_NEAR(std::sqrt(found.largest), 1, 1e-3);
}

TEST(SurfaceSamples, TakeEachVertexAndEdgeOnce)
{
    const Outline outline(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
    EXPECT_EQ(outline.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(outline.edges.size(), 5u);
}

TEST(SurfaceSamples, AreTheSameForAnyNumberOfThreads)
{
    const SurfaceDistance one = sphere(20, 1).tree(), two = noisy(sphere(20, 1), 0.1).tree();
    const SampledDistance alone = sample_faces(one, two, {.count = 30000, .threads = {1}});
    for (unsigned threads : {2u, 5u}) {
        const SampledDistance shared = sample_faces(one, two, {.count = 30000, .threads = {threads}});
        EXPECT_EQ(alone.sum, shared.sum);
        EXPECT_EQ(alone.largest, shared.largest);
    }
}

TEST(SurfaceSamples, NeverReachBeyondTheCertifiedBounds)
{
    for (const auto& [name, shape] : test_shapes::all()) {
        if (shape.triangles.empty()) continue;
        const Surface one = surface_of(shape), two = noisy(one, 0.1);
        const DistanceBounds found = bounds(one, two, {.tolerance = 1e-6});
        const double sampled = std::sqrt(sample_faces(one.tree(), two.tree(), {.count = 20000}).largest);
        EXPECT_LE(sampled, found.upper * (1 + 1e-12)) << name;
    }
}

TEST(SurfaceSamples, OfASurfaceWithoutAreaAreSharedOutEvenly)
{
    const Surface needles{{{0, 0, 1}, {2, 2, 2}}, {0, 0, 1, 1, 0, 1, 5, 0, 3}};
    const Surface plane{{{0, 1, 2}}, {-99, -99, 0, 200, -99, 0, -99, 200, 0}};
    EXPECT_NEAR(sample_faces(needles.tree(), plane.tree(), {.count = 1000}).rms(), std::sqrt(5.0), 1e-12);
}
