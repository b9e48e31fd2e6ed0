/// What distances to tetrahedra, and to all tetrahedra of a moving surface, promise.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/space_time_grid.h"

using namespace meshreel;
using namespace meshreel::metrics;

namespace {

using Corners = std::array<Point4, 4>;

/// By least squares on every corner, edge, face and the inside: the smallest whose weights are all positive.
double reference_distance(const Point4& p, const Corners& corners)
{
    double least = HUGE_VAL;
    for (unsigned chosen = 1; chosen < 16; ++chosen) {
        std::vector<Eigen::Vector4d> points;
        for (unsigned i = 0; i < 4; ++i)
            if (chosen >> i & 1) points.emplace_back(corners[i].data());
        Eigen::MatrixXd edges(4, static_cast<long>(points.size()) - 1);
        for (long i = 0; i < edges.cols(); ++i) edges.col(i) = points[static_cast<std::size_t>(i) + 1] - points[0];
        const Eigen::Vector4d from = Eigen::Vector4d(p.data()) - points[0];
        Eigen::VectorXd weights(0);
        if (edges.cols() > 0) weights = edges.completeOrthogonalDecomposition().solve(from);
        if (weights.size() > 0 && (weights.minCoeff() < 0 || weights.sum() > 1)) continue;
        least = std::min(least, weights.size() > 0 ? (from - edges * weights).norm() : from.norm());
    }
    return least;
}

Point4 random_point(Random& random, double size)
{
    Point4 p;
    for (double& x : p) x = random.uniform(-size, size);
    return p;
}

struct Moving {
    Animation animation;
    std::vector<Tetrahedron> tetrahedra;
    std::vector<double> axis;
    MovingSurface surface;

    explicit Moving(Animation made, double units = 1.0)
        : animation(std::move(made)), tetrahedra(interval_tetrahedra(animation.triangles, animation.vertex_count)),
          axis(animation.times_s)
    {
        for (double& w : axis) w *= units;
        surface = {animation.vertex_count,
                   tetrahedra,
                   {animation.positions.data(), animation.frame_count(), 3ul * animation.vertex_count},
                   axis};
    }
    Moving(const Moving&) = delete;

    double brute_force(const Point4& p) const
    {
        double least = HUGE_VAL;
        for (std::size_t k = 0; k < surface.intervals(); ++k)
            for (std::size_t t = 0; t < tetrahedra.size(); ++t)
                least = std::min(least, squared_distance_to_tetrahedron(p, surface.corners(k, t)));
        return least;
    }
};

std::vector<NearestQuery> random_queries(std::size_t count, double size, double w)
{
    Random random(7);
    std::vector<NearestQuery> queries(count);
    for (NearestQuery& q : queries) {
        q.at = random_point(random, size);
        q.at[3] = w + 0.1 * random.uniform();
    }
    return queries;
}

} // namespace

TEST(TetrahedronDistance, IsThatToTheNearestCornerEdgeFaceOrInside)
{
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        Corners corners;
        for (Point4& c : corners) c = random_point(random, 1.0);
        const Point4 p = random_point(random, i % 2 ? 0.7 : 3.0);
        ASSERT_NEAR(std::sqrt(squared_distance_to_tetrahedron(p, corners)), reference_distance(p, corners), 1e-12) << i;
    }
}

TEST(TetrahedronDistance, HoldsForSliversAndObtuseOnes)
{
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        Corners corners;
        for (Point4& c : corners) c = random_point(random, 1.0);
        const double thin = std::pow(10.0, -random.uniform(0.0, 6.0));
        for (Point4& c : corners)
            c[static_cast<std::size_t>(i) % 4] *= thin, c[static_cast<std::size_t>(i / 4) % 4] *= thin;
        const Point4 p = random_point(random, 1.0);
        ASSERT_NEAR(std::sqrt(squared_distance_to_tetrahedron(p, corners)), reference_distance(p, corners), 1e-9) << i;
    }
}

TEST(TetrahedronDistance, OfFlatOnesIsThatToTheTriangleSegmentOrPointTheyAre)
{
    const Point4 a{0, 0, 0, 0}, b{4, 0, 0, 0}, c{0, 4, 0, 0};
    EXPECT_DOUBLE_EQ(squared_distance_to_tetrahedron({1, 1, 3, 4}, {a, b, c, c}), 25);
    EXPECT_DOUBLE_EQ(squared_distance_to_tetrahedron({1, 1, 3, 0}, {a, a, b, c}), 9);
    EXPECT_DOUBLE_EQ(squared_distance_to_tetrahedron({1, 2, 0, 0}, {a, b, b, a}), 4);
    EXPECT_DOUBLE_EQ(squared_distance_to_tetrahedron({1, 2, 2, 0}, {a, a, a, a}), 9);
    EXPECT_DOUBLE_EQ(squared_distance_to_tetrahedron({1, 1, 1, 0}, {a, b, c, Point4{2, 2, 0, 0}}), 1); // all in a plane
}

TEST(TetrahedronDistance, IsExactlyZeroAtCornersAndNothingButRoundingInside)
{
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        Corners corners;
        for (Point4& c : corners) c = random_point(random, 1.0);
        for (const Point4& c : corners) EXPECT_EQ(squared_distance_to_tetrahedron(c, corners), 0.0);
        Point4 middle{};
        for (const Point4& c : corners)
            for (std::size_t k = 0; k < 4; ++k) middle[k] += c[k] / 4;
        EXPECT_LT(std::sqrt(squared_distance_to_tetrahedron(middle, corners)), 1e-15);
    }
}

TEST(SpaceTimeGrid, FindsTheNearestOfAllTetrahedraOfEveryShape)
{
    for (const auto& [name, a] : test_shapes::all()) {
        Moving moving(a, 5.0);
        SpaceTimeGrid grid(moving.surface);
        for (const double w : {-0.2, moving.axis.front(), 0.4, moving.axis.back() + 1.0}) {
            std::vector<NearestQuery> queries = random_queries(20, 3.0, w);
            grid.nearest(queries);
            for (const NearestQuery& q : queries)
                ASSERT_DOUBLE_EQ(q.squared, moving.brute_force(q.at)) << name << ' ' << w;
        }
    }
}

TEST(SpaceTimeGrid, FindsTheNearestOfAllTetrahedraFarAndNear)
{
    Moving moving(*shapes::generate(*shapes::find("swimmer"), {.vertices = 120, .frames = 9}), 3.0);
    SpaceTimeGrid grid(moving.surface);
    for (const double size : {0.5, 2.0, 20.0, 1000.0}) {
        std::vector<NearestQuery> queries = random_queries(100, size, 0.3);
        grid.nearest(queries);
        for (const NearestQuery& q : queries) ASSERT_DOUBLE_EQ(q.squared, moving.brute_force(q.at)) << size;
    }
}

TEST(SpaceTimeGrid, IsTheSameForAnyHintNumberOfThreadsAndMemory)
{
    Moving moving(*shapes::generate(*shapes::find("jelly"), {.vertices = 400, .frames = 12}), 2.0);
    const std::vector<NearestQuery> queries = random_queries(600, 1.5, 0.2);
    std::vector<NearestQuery> one = queries, many = queries, hinted = queries;
    for (std::size_t i = 0; i < hinted.size(); ++i)
        hinted[i].nearest = static_cast<std::uint32_t>(i % moving.tetrahedra.size());
    SpaceTimeGrid(moving.surface, Threads{1}).nearest(one);
    SpaceTimeGrid(moving.surface, Threads{3}, 1).nearest(many);
    SpaceTimeGrid(moving.surface, Threads{2}).nearest(hinted);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        EXPECT_EQ(one[i].squared, many[i].squared);
        EXPECT_DOUBLE_EQ(one[i].squared, hinted[i].squared);
    }
}

TEST(SpaceTimeGrid, BuildsEachLayerOnceAndKeepsFew)
{
    Moving moving(*shapes::generate(*shapes::find("jelly"), {.vertices = 400, .frames = 60}), 10.0);
    SpaceTimeGrid grid(moving.surface);
    std::size_t bytes_of_ten = 0;
    for (std::size_t f = 0; f < 60; ++f) {
        std::vector<NearestQuery> queries(400);
        for (std::uint32_t v = 0; v < 400; ++v) queries[v].at = moving.surface.point(f, v);
        grid.nearest(queries);
        if (f == 10) bytes_of_ten = grid.cost().most_bytes;
    }
    EXPECT_EQ(grid.cost().layers, 59u);
    EXPECT_LT(grid.cost().most_bytes, 2 * bytes_of_ten);
}

TEST(SpaceTimeGrid, StaysSmallWhereTheWholeMeshJumps)
{
    Animation a = *shapes::generate(*shapes::find("jelly"), {.vertices = 1000, .frames = 3});
    for (std::size_t i = 0; i < 3000; ++i)
        a.frame(1)[i] += 50.0f * static_cast<float>(i % 3 + 1); // as at a cut of a film
    Moving moving(a, 0.1);
    const SpaceTimeLayer layer(moving.surface, 0, 0.01, {});
    EXPECT_LT(layer.bytes(), 20'000'000u);
    NearestQuery query{.at = {20, 40, 60, 0.001}};
    MetTetrahedra met(moving.tetrahedra.size());
    layer.search(query, met);
    double least = HUGE_VAL;
    for (std::size_t t = 0; t < moving.tetrahedra.size(); ++t)
        least = std::min(least, squared_distance_to_tetrahedron(query.at, moving.surface.corners(0, t)));
    EXPECT_DOUBLE_EQ(query.squared, least);
}

TEST(SpaceTimeGrid, OfNothingIsInfinitelyFar)
{
    Moving moving(test_shapes::points_only());
    std::vector<NearestQuery> queries(3);
    SpaceTimeGrid(moving.surface).nearest(queries);
    for (const NearestQuery& q : queries) EXPECT_EQ(q.squared, HUGE_VAL);
}
