/// Whoever is near is found, once, and the nearest come first.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meshreel {
namespace {

/// Points on a lattice of so many a side, in a scrambled order: many are equally near.
std::vector<Point> lattice(std::uint32_t side)
{
    std::vector<Point> points;
    const std::uint32_t count = side * side * side;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = static_cast<std::uint32_t>(std::uint64_t{i} * 7919 % count);
        points.push_back({0.5 * (place % side), 0.5 * (place / side % side), 0.5 * (place / side / side)});
    }
    return points;
}

std::vector<std::uint32_t> by_hand(const std::vector<Point>& points, const Point& place, std::size_t limit,
                                   double bound)
{
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < limit; ++i)
        if (squared_gap(place, points[i]) <= bound) near.push_back(i);
    std::ranges::stable_sort(near, {}, [&](std::uint32_t i) { return squared_gap(place, points[i]); });
    return near;
}

/// Everything within the bound, sorted.
std::vector<std::uint32_t> found(const Cells& cells, const Point& place, std::size_t limit, double bound)
{
    Cells::Found found;
    cells.near(place, limit, bound, found);
    std::vector<std::uint32_t> near(found.count);
    EXPECT_EQ(found.sorted(near), near.size());
    return near;
}

TEST(Cells, FindAllThatAreNear)
{
    const std::vector<Point> points = lattice(11);
    Cells cells({0, 0, 0});
    for (const double reach : {0.3, 0.5, 0.8, 1.7, 20.0}) {
        cells.fill(points, reach);
        for (const Point& place : {Point{0, 0, 0}, Point{2.5, 2.5, 2.5}, Point{1.2, 3.3, 4.9}, Point{5, 0, 2.25}})
            for (const std::size_t limit : {std::size_t{0}, std::size_t{700}, points.size()})
                for (const double bound : {reach * reach, 0.4 * reach * reach, 0.0})
                    EXPECT_EQ(found(cells, place, limit, bound), by_hand(points, place, limit, bound)) << reach;
    }
}

TEST(Cells, ForgetWhatTheyHeld)
{
    const std::vector<Point> points = lattice(5);
    Cells cells({0, 0, 0});
    cells.fill(points, 1.0);
    cells.fill(std::span(points).first(3), 0.6);
    EXPECT_EQ(found(cells, points[1], 3, 0.36), by_hand(points, points[1], 3, 0.36));
    cells.fill({}, 0.1);
    EXPECT_TRUE(found(cells, points[1], 3, 0.01).empty());
}

TEST(Cells, NearestAreTakenWhereFewerAreWanted)
{
    const std::vector<Point> points = lattice(9);
    Cells cells({0, 0, 0});
    cells.fill(points, 2.0);
    Cells::Found found;
    for (const double bound : {0.3, 0.7, 4.0}) { // some, and more than are ranked at once
        cells.near({2.1, 2.0, 1.9}, points.size(), bound, found);
        std::vector<std::uint32_t> expected = by_hand(points, {2.1, 2.0, 1.9}, points.size(), bound), nearest(5);
        ASSERT_GT(expected.size(), 4u);
        expected.resize(5);
        EXPECT_EQ(found.sorted(nearest), 5u);
        EXPECT_EQ(nearest, expected);
    }
    EXPECT_EQ(found.sorted({}), 0u);
}

} // namespace
} // namespace meshreel
