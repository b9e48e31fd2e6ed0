/// EV and WEV: closed-form values, their window, and their defined values at the edges.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/metrics/measure.h"
#include "tests/metrics/made.h"

using namespace meshreel;
using made::points;

namespace {

double measure(const char* metric, double window, const Animation& original, const Animation& distorted)
{
    return metrics::measure(original, distorted, {metrics::find(metric), {window}})->values[0];
}

const Animation ev_triangle = points(3, {0, 0, 0, 1, 0, 0, 0, 2, 0}, {{0, 1, 2}});

} // namespace

TEST(Ev, ComparesEachErrorVectorWithTheMeanOfItsNeighbours)
{
    // Vertex 0 is off by 1: its neighbours say 0, theirs say 1/2.
    EXPECT_DOUBLE_EQ(measure("ev", 0, ev_triangle, points(3, {0, 0, 1, 1, 0, 0, 0, 2, 0}, {{0, 1, 2}})),
                     (1 + .5 + .5) / 3);
}

TEST(Wev, NeighboursCountByTheInverseLengthOfTheirEdge)
{
    // Edges of vertex 0 have lengths 1 and 2, the other one sqrt(5).
    const double d = 1 / std::sqrt(5.0), at_1 = 1 / (1 + d), at_2 = 0.5 / (0.5 + d);
    EXPECT_DOUBLE_EQ(measure("wev", 0, ev_triangle, points(3, {0, 0, 1, 1, 0, 0, 0, 2, 0}, {{0, 1, 2}})),
                     (1 + at_1 + at_2) / 3);
}

TEST(Ev, DoesNotSeeWhatAllShare)
{
    EXPECT_EQ(measure("ev", 3, ev_triangle, points(3, {0, 0, 1, 1, 0, 1, 0, 2, 1}, {{0, 1, 2}})), 0.0);
}

TEST(Ev, ItsWindowSeesWhatShakes)
{
    // All vertices up by 1 in frame 0 and down by 1 in frame 1: over both frames the mean is 0.
    const Animation still = points(3, {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0}, {{0, 1, 2}});
    const Animation shaken = points(3, {0, 0, 1, 1, 0, 1, 0, 2, 1, 0, 0, -1, 1, 0, -1, 0, 2, -1}, {{0, 1, 2}});
    EXPECT_EQ(measure("ev", 0, still, shaken), 0.0);
    EXPECT_DOUBLE_EQ(measure("ev", 1, still, shaken), 1.0);
}

TEST(Ev, IsCutAtTheEndsOfTheAnimation)
{
    // One frame of three is off by 3: windows of two, three and two frames.
    std::vector<float> positions;
    for (const float z : {3.0f, 0.0f, 0.0f})
        for (const float x : {0.0f, 1.0f, 5.0f}) positions.insert(positions.end(), {x, x * x, z});
    std::vector<float> flat = positions;
    for (std::size_t i = 2; i < flat.size(); i += 3) flat[i] = 0;
    const std::vector<Triangle> triangles{{0, 1, 2}};
    EXPECT_DOUBLE_EQ(measure("ev", 1, points(3, flat, triangles), points(3, positions, triangles)),
                     ((3 - 1.5) + 1.0 + 0.0) / 3);
}

TEST(Ev, VerticesWithoutNeighboursAddNothing)
{
    EXPECT_EQ(measure("ev", 1, points(1, {0, 0, 0}), points(1, {1, 0, 0})), 0.0);
    const Animation point = points(3, {1, 1, 1, 1, 1, 1, 1, 1, 1}, {{0, 1, 2}});
    EXPECT_EQ(measure("wev", 1, point, ev_triangle), 0.0) << "edges of no length weigh nothing";
}
