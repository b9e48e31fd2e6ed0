/// What kriging weights promise.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "meshreel/predict/kriging.h"

using namespace meshreel::predict;

namespace {

using Places = std::vector<std::array<double, 2>>;
using Weights = std::array<double, Kriging::most>;

/// Weights of neighbours of the origin of a plane, which is the lane-th point of some.
Weights weights_around(const Places& places, const Likeness& likeness, std::size_t lane = 0)
{
    Kriging kriging(2);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) kriging.differences(k)[i] = places[i][k];
    kriging.set(lane, places.size(), 2);
    const auto all = kriging.weights(places.size(), likeness);
    Weights weights;
    for (std::size_t i = 0; i < Kriging::most; ++i) weights[i] = all[i][lane];
    return weights;
}

double sum(const Weights& weights)
{
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

} // namespace

TEST(Kriging, GivesWeightsOfSumOne)
{
    const Places places{{1, 0}, {0, 2}, {-3, 1}, {0.5, -0.5}, {2, 2}};
    for (const Likeness likeness : {Likeness{}, Likeness{0, 0.1, 0, 0}, Likeness{400, 4, 0.01, 6}})
        EXPECT_NEAR(sum(weights_around(places, likeness)), 1.0, 1e-9);
}

TEST(Kriging, TreatsNeighboursAlikeThatLieAlike)
{
    const auto weights = weights_around({{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, {});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(weights[i], 0.25, 1e-12);
}

TEST(Kriging, InterpolatesALinearFunctionWhereverTheNeighboursLie)
{
    const Places places{{1, 0.2}, {0.3, 2}, {-3, 1}, {0.5, -0.5}, {2, 2}, {-1, -2}};
    const auto weights = weights_around(places, {1e6, 1, 1e-6, 0});
    double value = 0;
    std::size_t i = 0;
    for (const auto& place : places) value += weights[i++] * (7 + 3 * place[0] - 2 * place[1]);
    EXPECT_NEAR(value, 7, 1e-4);
}

TEST(Kriging, TrustsTheNearestMost)
{
    const auto weights = weights_around({{0.1, 0}, {0, 2}, {-2, 0}}, {0, 1, 0.01, 0});
    EXPECT_GT(weights[0], 0.8);
}

TEST(Kriging, AveragesNeighboursThatCoincideWithThePoint)
{
    const auto weights = weights_around({{0, 0}, {0, 0}}, {});
    EXPECT_NEAR(weights[0], 0.5, 1e-9);
    EXPECT_NEAR(weights[1], 0.5, 1e-9);
}

TEST(Kriging, GivesAPointTheSameWeightsWhicheverItIsOfSome)
{
    const Places places{{1, 0.2}, {0.3, 2}, {-3, 1}, {0.5, -0.5}, {2, 2}, {-1, -2}};
    for (std::size_t lane = 1; lane < Kriging::lanes; ++lane)
        EXPECT_EQ(weights_around(places, {}, lane), weights_around(places, {}));
}
