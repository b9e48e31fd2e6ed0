/// DA: ribbons in closed form, and their defined values at the edges.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/metrics/measure.h"
#include "tests/metrics/made.h"

using namespace meshreel;
using made::points;

namespace {

double measure(const char* value, const Animation& original, const Animation& distorted)
{
    return *metrics::measured(value, original, distorted);
}

/// A point that does not move, beside one that gives the extent W = 4.
Animation two_points(float first_x, float second_x)
{
    return points(2, {first_x, 0, 0, 0, 4, 0, second_x, 0, 0, 0, 4, 0});
}

} // namespace

TEST(Da, OfAConstantDistanceIsThatDistanceOverTheExtent)
{
    // One coordinate of six is off by 0.5 all the time.
    EXPECT_DOUBLE_EQ(measure("da", two_points(0, 0), two_points(0.5, 0.5)), 0.5 / (6 * 4));
    EXPECT_DOUBLE_EQ(measure("da_peak", two_points(0, 0), two_points(0.5, 0.5)), 0.5 / 4);
}

TEST(Da, OfATwistedRibbonIsThatOfItsTwoTriangles)
{
    // From -0.5 to 1.5: triangles over a quarter and three quarters of a second, areas 1/16 and 9/16.
    EXPECT_DOUBLE_EQ(measure("da", two_points(0, 0), two_points(-0.5, 1.5)), (1.0 / 16 + 9.0 / 16) / (6 * 4));
    EXPECT_DOUBLE_EQ(measure("da_peak", two_points(0, 0), two_points(-0.5, 1.5)), 1.5 / 4);
}

TEST(Da, LikesOscillationAsTheThesisSays)
{
    EXPECT_LT(measure("da", two_points(0, 0), two_points(-1, 1)), measure("da", two_points(0, 0), two_points(1, 1)));
}

TEST(Da, WeighsRibbonsByTheirDuration)
{
    Animation original = points(1, {0, 0, 0, 1, 0, 0, 0, 0, 0}), moved = points(1, {1, 0, 0, 2, 0, 0, 0, 0, 0});
    original.times_s = moved.times_s = {0.0, 3.0, 4.0};
    EXPECT_DOUBLE_EQ(measure("da", original, moved), (3.0 * 1.0 + 1.0 * 0.5) / (3 * 4));
}

TEST(Da, OfASingleFrameIsTheMeanDifference)
{
    const Animation original = points(1, {0, 0, 0}), beside = points(2, {0, 0, 0, 2, 0, 0}),
                    moved = points(2, {0, 0, 1, 2, 0, 0});
    EXPECT_DOUBLE_EQ(measure("da", beside, moved), 1.0 / (6 * 2));
    EXPECT_EQ(measure("da", original, original), 0.0);
    EXPECT_TRUE(std::isinf(measure("da", original, points(1, {0, 1, 0})))) << "a single point has no extent";
}
