/// The neighbourhood average.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "meshreel/predict/average.h"

using namespace meshreel;

TEST(Average, IsTheMeanOfTheNeighbours)
{
    EXPECT_DOUBLE_EQ(predict::average(std::vector{1.0, 2.0, 6.0, -1.0}), 2.0); // (8.4)
    EXPECT_DOUBLE_EQ(predict::average(std::vector{-3.5}), -3.5);
}

TEST(Average, LearnsNothing)
{
    predict::Average predictor(0.01);
    predictor.start(2);
    const std::vector<double> y{1.0, 3.0};
    predictor.learn(y, 100.0);
    EXPECT_DOUBLE_EQ(predictor.guess(y), 2.0);
}
