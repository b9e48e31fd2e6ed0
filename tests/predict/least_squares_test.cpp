/// What recursive least squares learns.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "meshreel/predict/least_squares.h"

using namespace meshreel::predict;

namespace {

using Pair = LeastSquares<2>;

/// Shows n samples of y = a u0 + b u1.
void show(Pair& learner, double a, double b, int n)
{
    std::mt19937 random(3);
    for (int i = 0; i < n; ++i) {
        const Pair::Features u{static_cast<double>(random() % 200) / 100 - 1,
                               static_cast<double>(random() % 200) / 100 - 1};
        learner.learn(u, a * u[0] + b * u[1] - learner.predict(u));
    }
}

} // namespace

TEST(LeastSquares, LearnsALinearLaw)
{
    Pair learner;
    show(learner, 2, -3, 200);
    EXPECT_NEAR(learner.predict({1, 1}), -1, 0.02);
}

TEST(LeastSquares, ForgetsALawThatNoLongerHolds)
{
    Pair learner;
    show(learner, 2, -3, 1000);
    show(learner, -1, 1, 3000);
    EXPECT_NEAR(learner.predict({1, 0}), -1, 0.02);
}

TEST(LeastSquares, StaysFiniteWhereNothingIsToBeSeen)
{
    Pair learner;
    show(learner, 2, -3, 100);
    for (int i = 0; i < 1'000'000; ++i) learner.learn({0, 0}, 0);
    show(learner, 2, -3, 10);
    EXPECT_NEAR(learner.predict({1, 1}), -1, 0.1);
}
