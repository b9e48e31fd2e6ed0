/// TD: closed-form values, what it does not see, and its defined values at the edges.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/metrics/measure.h"
#include "tests/metrics/made.h"

using namespace meshreel;
using made::points;

namespace {

double td(const Animation& original, const Animation& distorted)
{
    return *metrics::measured("td", original, distorted);
}

const Animation td_triangle = points(3, {0, 0, 0, 3, 0, 0, 0, 4, 0}, {{0, 1, 2}});

} // namespace

TEST(Td, IsTheSquaredChangeOfAreaOverTheDiagonal)
{
    // Area 6 becomes 12; the diagonal is 5.
    EXPECT_DOUBLE_EQ(td(td_triangle, points(3, {0, 0, 0, 6, 0, 0, 0, 4, 0}, {{0, 1, 2}})), 36.0 / 5.0);
}

TEST(Td, IsAMeanOverTrianglesAndFrames)
{
    const Animation original =
        points(3, {0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 0, 3, 0, 0, 0, 4, 0}, {{0, 1, 2}, {0, 0, 1}});
    const Animation moved = points(3, {0, 0, 0, 6, 0, 0, 0, 4, 0, 0, 0, 0, 3, 0, 0, 0, 4, 0}, {{0, 1, 2}, {0, 0, 1}});
    EXPECT_DOUBLE_EQ(td(original, moved), 36.0 / (2 * 2 * 5.0));
}

TEST(Td, DoesNotSeeAShearThatKeepsTheArea)
{
    EXPECT_EQ(td(td_triangle, points(3, {0, 0, 0, 3, 0, 0, 7, 4, 0}, {{0, 1, 2}})), 0.0);
}

TEST(Td, IsDefinedWithoutTrianglesAndWithoutExtent)
{
    EXPECT_EQ(td(points(1, {0, 0, 0}), points(1, {1, 0, 0})), 0.0);
    const Animation point = points(3, {1, 1, 1, 1, 1, 1, 1, 1, 1}, {{0, 1, 2}});
    EXPECT_EQ(td(point, point), 0.0);
    EXPECT_TRUE(std::isinf(td(point, td_triangle)));
}
