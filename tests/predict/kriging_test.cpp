/// What kriging weights promise.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numeric>

#include "meshreel/predict/kriging.h"

using namespace meshreel::predict;

namespace {

/// Neighbours of the origin of a plane.
Kriging around(std::initializer_list<std::array<double, 2>> places)
{
    Kriging kriging(2);
    std::size_t i = 0;
    for (const auto& place : places) {
        kriging.differences(0)[i] = place[0];
        kriging.differences(1)[i++] = place[1];
    }
    return kriging;
}

double sum(const std::array<double, Kriging::most>& weights)
{
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

} // namespace

TEST(Kriging, GivesWeightsOfSumOne)
{
    const Kriging kriging = around({{1, 0}, {0, 2}, {-3, 1}, {0.5, -0.5}, {2, 2}});
    for (const Likeness likeness : {Likeness{}, Likeness{0, 0.1, 0, 0}, Likeness{400, 4, 0.01, 6}})
        EXPECT_NEAR(sum(kriging.weights(5, 2, likeness)), 1.0, 1e-9);
}

TEST(Kriging, TreatsNeighboursAlikeThatLieAlike)
{
    const auto weights = around({{1, 0}, {0, 1}, {-1, 0}, {0, -1}}).weights(4, 2, {});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(weights[i], 0.25, 1e-12);
}

TEST(Kriging, InterpolatesALinearFunctionWhereverTheNeighboursLie)
{
    const std::initializer_list<std::array<double, 2>> places{{1, 0.2},    {0.3, 2}, {-3, 1},
                                                              {0.5, -0.5}, {2, 2},   {-1, -2}};
    const auto weights = around(places).weights(6, 2, {1e6, 1, 1e-6, 0});
    double value = 0;
    std::size_t i = 0;
    for (const auto& place : places) value += weights[i++] * (7 + 3 * place[0] - 2 * place[1]);
    EXPECT_NEAR(value, 7, 1e-4);
}

TEST(Kriging, TrustsTheNearestMost)
{
    const auto weights = around({{0.1, 0}, {0, 2}, {-2, 0}}).weights(3, 2, {0, 1, 0.01, 0});
    EXPECT_GT(weights[0], 0.8);
}

TEST(Kriging, AveragesNeighboursThatCoincideWithThePoint)
{
    const auto weights = around({{0, 0}, {0, 0}}).weights(2, 2, {});
    EXPECT_NEAR(weights[0], 0.5, 1e-9);
    EXPECT_NEAR(weights[1], 0.5, 1e-9);
}
