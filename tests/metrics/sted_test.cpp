/// STED: the reference vectors to the digit, closed-form values, and its defined values at the edges.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/sted.h"
#include "tests/metrics/made.h"
#include "tests/metrics/reference_vectors.h"

using namespace meshreel;
using made::points;
using metrics::StedOptions;

namespace {

metrics::Sted measure(const Animation& original, const Animation& distorted, const StedOptions& options = {})
{
    return metrics::sted(metrics::pair_of(original, distorted), options);
}

const Animation right_triangle = points(3, {0, 0, 0, 3, 0, 0, 0, 4, 0}, {{0, 1, 2}});

} // namespace

TEST(Sted, ReproducesTheReferenceVectorsToTwelveDigits)
{
    for (const reference::Vector& vector : reference::vectors) {
        const reference::Grid grid = reference::grid(vector);
        EXPECT_NEAR(metrics::sted(grid.pair()).total / vector.sted, 1.0, 1e-12) << vector.distortion;
    }
}

TEST(Sted, SpatialPartOfATriangleIsTheWeightedDeviationOfItsThreeEdges)
{
    // Edges 3, 4, 5 become 3, 4, 1: differences 0, 0, 0.8, mean 1/3, variance 7/45 at every vertex.
    const Animation folded = points(3, {0, 0, 0, 0, 3, 0, 0, 4, 0}, {{0, 1, 2}});
    EXPECT_NEAR(measure(right_triangle, folded).spatial, std::sqrt(7.0 / 45.0), 1e-15);
    EXPECT_EQ(measure(right_triangle, folded).temporal, 0.0) << "a single frame has no speed";
}

TEST(Sted, TemporalPartOfATrembleIsItsSpeedOverTheFrameDistance)
{
    // Two still points, one unit apart, made to move by sqrt(3) fd a frame: speeds fd become 2 fd.
    StedOptions options;
    options.frame_distance = 0.5;
    const float step = std::sqrt(0.75f);
    const Animation still = points(2, {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0});
    const Animation moving = points(2, {0, 0, 0, 1, 0, 0, 0, step, 0, 1, step, 0, 0, 0, 0, 1, 0, 0});
    EXPECT_NEAR(measure(still, moving, options).temporal, 1.0, 1e-7);
    EXPECT_NEAR(measure(still, moving, options).total, options.temporal_weight, 1e-11);
}

TEST(Sted, UniformStretchingIsNotSeenInSpace)
{
    Animation doubled = test_shapes::torus();
    for (float& x : doubled.positions) x *= 2;
    EXPECT_EQ(measure(test_shapes::torus(), doubled).spatial, 0.0);
}

TEST(Sted, SignsCanBeLeftOut)
{
    // Edges 3, 4, 5 become 6, 4, sqrt(52): differences of one sign. With one edge shorter and one longer, signs matter.
    const Animation wider = points(3, {0, 0, 0, 6, 0, 0, 0, 4, 0}, {{0, 1, 2}});
    const Animation skewed = points(3, {0, 0, 0, 4, 0, 0, 0, 2, 0}, {{0, 1, 2}});
    StedOptions absolute;
    absolute.absolute_difference = true;
    EXPECT_DOUBLE_EQ(measure(right_triangle, wider).spatial, measure(right_triangle, wider, absolute).spatial);
    EXPECT_GT(measure(right_triangle, skewed).spatial, measure(right_triangle, skewed, absolute).spatial);
}

TEST(Sted, EdgesWithoutLengthWeighNothing)
{
    const Animation flat = points(4, {0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 4, 0}, {{0, 1, 2}, {2, 1, 3}});
    const Animation moved = points(4, {0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 4, 9}, {{0, 1, 2}, {2, 1, 3}});
    EXPECT_TRUE(std::isfinite(measure(flat, moved).total));
    const Animation point = points(3, {1, 1, 1, 1, 1, 1, 1, 1, 1}, {{0, 1, 2}});
    EXPECT_EQ(measure(point, right_triangle).spatial, 0.0) << "no edge has a length";
}

TEST(Sted, IsolatedVerticesAddNothingInSpaceButCountInTheMean)
{
    const Animation lonely = points(4, {0, 0, 0, 3, 0, 0, 0, 4, 0, 9, 9, 9}, {{0, 1, 2}});
    const Animation folded = points(4, {0, 0, 0, 0, 3, 0, 0, 4, 0, 5, 5, 5}, {{0, 1, 2}});
    EXPECT_NEAR(measure(lonely, folded).spatial, 0.75 * std::sqrt(7.0 / 45.0), 1e-15);
}

TEST(Sted, DoesNotDependOnTheNumberOfThreads)
{
    for (const auto& [name, original] : test_shapes::all()) {
        Animation noisy = original;
        Random random(3);
        for (float& x : noisy.positions) x += static_cast<float>(random.uniform(-0.01, 0.01));
        StedOptions one, three;
        one.threads = {1};
        three.threads = {3};
        EXPECT_EQ(measure(original, noisy, one).total, measure(original, noisy, three).total) << name;
        EXPECT_GT(measure(original, noisy).total, 0.0) << name;
    }
}

TEST(Sted, AWiderNeighbourhoodOfAOneTriangleMeshIsTheSame)
{
    const Animation folded = points(3, {0, 0, 0, 0, 3, 0, 0, 4, 0}, {{0, 1, 2}});
    StedOptions wide;
    wide.distance = 7;
    EXPECT_EQ(measure(right_triangle, folded).spatial, measure(right_triangle, folded, wide).spatial);
}
