/// What a distance to a surface promises.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "meshreel/base/random.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/surface_distance.h"

using namespace meshreel;
using namespace meshreel::metrics;

namespace {

constexpr std::array<SurfaceDistance::Point, 3> flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

} // namespace

TEST(SurfaceDistance, IsThatToTheFaceTheEdgeOrTheCornerWhicheverIsNearest)
{
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({1, 1, 3}, flat), 9);
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({1, -2, 0}, flat), 4);
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({-3, -4, 0}, flat), 25);
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({4, 4, 0}, flat), 8);
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({1, 1, 0}, flat), 0);
}

TEST(SurfaceDistance, TakesDegenerateTrianglesForTheSegmentOrPointThatTheyAre)
{
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({1, 2, 0}, {{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}}), 4);
    EXPECT_DOUBLE_EQ(squared_distance_to_triangle({1, 2, 2}, {{{1, 0, 2}, {1, 0, 2}, {1, 0, 2}}}), 4);
}

TEST(SurfaceDistance, IsNeverMoreThanToAnyPointOfATriangleThoughItBeASliver)
{
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
        TriangleCorners t;
        for (Point& p : t) p = {random.uniform(), random.uniform(), random.uniform()};
        const double height = std::pow(10.0, -static_cast<double>(random.below(20)));
        t[2] =
            plus(between(t[0], t[1], random.uniform(-1, 2)), times(height, t[2])); // beside the side or its extension
        const Point p{random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2)};
        const double found = std::sqrt(squared_distance_to_triangle(p, t));
        for (double u = 0; u <= 1; u += 0.0625)
            for (double v = 0; u + v <= 1; v += 0.0625) {
                const Point q = plus(t[0], plus(times(u, minus(t[1], t[0])), times(v, minus(t[2], t[0]))));
                ASSERT_LE(found, std::sqrt(squared_distance(p, q)) + 1e-14) << height;
            }
    }
}

TEST(SurfaceDistance, FindsTheNearestOfAllTriangles)
{
    const Animation torus = test_shapes::torus();
    const SurfaceDistance distance(torus.triangles, torus.frame(0));
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
        SurfaceDistance::Point p;
        for (double& x : p) x = static_cast<double>(random() % 4000) / 1000 - 2;
        double least = HUGE_VAL;
        for (const Triangle& t : torus.triangles) {
            std::array<SurfaceDistance::Point, 3> corners;
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t c = 0; c < 3; ++c) corners[j][c] = torus.frame(0)[3ul * t[j] + c];
            least = std::min(least, squared_distance_to_triangle(p, corners));
        }
        EXPECT_DOUBLE_EQ(distance.squared(p), least);
    }
}

TEST(SurfaceDistance, ToNothingIsInfinite)
{
    EXPECT_EQ(SurfaceDistance({}, {}).squared({0, 0, 0}), HUGE_VAL);
}
