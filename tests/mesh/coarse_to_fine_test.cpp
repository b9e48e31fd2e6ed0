/// What an order from coarse to fine promises.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "meshreel/mesh/coarse_to_fine.h"

using namespace meshreel;

namespace {

Matrix<double> scattered(std::size_t count)
{
    Matrix<double> points(count, 3);
    std::mt19937 random(7);
    for (double& x : points.values) x = static_cast<double>(random() % 100000) / 1000;
    return points;
}

double distance_between(const Matrix<double>& X, std::size_t a, std::size_t b)
{
    return std::hypot(X(a, 0) - X(b, 0), X(a, 1) - X(b, 1), X(a, 2) - X(b, 2));
}

std::vector<std::size_t> levels_of(const CoarseToFine& order)
{
    std::vector<std::size_t> levels(order.order.size());
    std::size_t place = 0;
    for (std::size_t l = 0; l < order.ends.size(); ++l)
        for (; place < order.ends[l]; ++place) levels[order.order[place]] = l;
    return levels;
}

} // namespace

TEST(CoarseToFine, TakesEveryPointOnce)
{
    CoarseToFine order = coarse_to_fine(scattered(700).view(), 5, {1});
    std::sort(order.order.begin(), order.order.end());
    ASSERT_EQ(order.order.size(), 700u);
    for (std::uint32_t i = 0; i < 700; ++i) EXPECT_EQ(order.order[i], i);
}

TEST(CoarseToFine, KeepsPointsOfCoarseLevelsApart)
{
    const Matrix<double> X = scattered(500);
    const CoarseToFine order = coarse_to_fine(X.view(), 5, {1});
    double diagonal = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        double low = 1e9, high = -1e9;
        for (std::size_t i = 0; i < X.rows; ++i) low = std::min(low, X(i, c)), high = std::max(high, X(i, c));
        diagonal += (high - low) * (high - low);
    }
    for (const std::size_t level : {5u, 10u, 20u})
        for (std::size_t i = 0; i < order.ends[level]; ++i)
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GE(distance_between(X, order.order[i], order.order[j]),
                          0.999 * std::sqrt(diagonal) / 2 / std::pow(1.1, static_cast<double>(level)));
}

TEST(CoarseToFine, FindsTheNearestPointsOfEarlierLevels)
{
    const Matrix<double> X = scattered(400);
    const CoarseToFine order = coarse_to_fine(X.view(), 6, {1});
    const std::vector<std::size_t> levels = levels_of(order);
    for (std::size_t i = 0; i < X.rows; ++i) {
        std::vector<double> distances, found;
        for (std::size_t j = 0; j < X.rows; ++j)
            if (levels[j] < levels[i]) distances.push_back(distance_between(X, i, j));
        std::sort(distances.begin(), distances.end());
        distances.resize(std::min<std::size_t>(distances.size(), 6));
        for (std::size_t n = 0; n < 6 && order.nearest(i, n) != CoarseToFine::nobody; ++n)
            found.push_back(distance_between(X, i, order.nearest(i, n)));
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, distances);
    }
}

TEST(CoarseToFine, FindsNeighboursHoweverFarTheyAre)
{
    Matrix<double> X = scattered(60); // two clouds, a thousand times as far from each other as they are wide
    for (std::size_t i = 0; i < 8; ++i) X(i, 0) += 1e5;
    const CoarseToFine order = coarse_to_fine(X.view(), 12, {1});
    const std::vector<std::size_t> levels = levels_of(order);
    for (std::size_t i = 0; i < X.rows; ++i) {
        const auto earlier = std::count_if(levels.begin(), levels.end(), [&](std::size_t l) { return l < levels[i]; });
        const auto none = std::count(order.nearest.row(i).begin(), order.nearest.row(i).end(), CoarseToFine::nobody);
        EXPECT_EQ(12 - none, std::min<std::ptrdiff_t>(12, earlier));
    }
}

TEST(CoarseToFine, PrefersWhoComesFirstOfEquallyNear)
{
    Matrix<double> X(4, 3);
    X.values = {0, 0, 0, 0, 2, 0, 6, 2, 0, 0, 1, 0}; // the last is in the middle between the first two
    const CoarseToFine order = coarse_to_fine(X.view(), 1, {1});
    EXPECT_EQ(order.order, (std::vector<std::uint32_t>{0, 2, 1, 3}));
    EXPECT_EQ(order.nearest(3, 0), 0u);
}

TEST(CoarseToFine, IsQuickWhereAllPointsCoincide)
{
    const Matrix<double> X(50000, 3);
    const CoarseToFine order = coarse_to_fine(X.view(), 24, {1});
    EXPECT_EQ(order.order.size(), 50000u);
    EXPECT_EQ(order.ends.front(), 50000u); // a box without a diagonal keeps nobody apart
}

TEST(CoarseToFine, IsTheSameForAnyNumberOfThreads)
{
    const Matrix<double> X = scattered(3000);
    const CoarseToFine one = coarse_to_fine(X.view(), 24, {1}), three = coarse_to_fine(X.view(), 24, {3});
    EXPECT_EQ(one.order, three.order);
    EXPECT_EQ(one.nearest.values, three.nearest.values);
}

TEST(CoarseToFine, TakesWhatIsNoNumberForZero)
{
    Matrix<double> X = scattered(50);
    X(3, 1) = std::numeric_limits<double>::quiet_NaN();
    X(4, 2) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(coarse_to_fine(X.view(), 4, {1}).order.size(), 50u);
}
