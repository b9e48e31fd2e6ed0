/// The elementary functions of the format agree with the mathematical ones.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/base/exact.h"

using namespace meshreel;

TEST(Exact, SineAndCosineAgreeWithTheMathematicalOnes)
{
    for (double x = -1000.0; x < 1000.0; x += 0.37) {
        EXPECT_NEAR(exact::sin(x), std::sin(x), 1e-12);
        EXPECT_NEAR(exact::cos(x), std::cos(x), 1e-12);
    }
}

TEST(Exact, LogarithmAgreesWithTheMathematicalOne)
{
    for (double x = 1e-300; x < 1e300; x *= 1.37) EXPECT_NEAR(exact::log(x), std::log(x), 1e-12);
    for (double x = 0.5; x < 3.0; x += 0.001) EXPECT_NEAR(exact::log(x), std::log(x), 1e-13);
    EXPECT_EQ(exact::log(1.0), 0.0);
}

TEST(Exact, PowerOfAFractionIsAChainOfSquareRoots)
{
    EXPECT_EQ(exact::power(2.0, 10.0), 1024.0);
    EXPECT_EQ(exact::power(9.0, 0.5), 3.0);
    EXPECT_NEAR(exact::power(17.0, 1.75), std::pow(17.0, 1.75), 1e-10);
    EXPECT_NEAR(exact::power(3.0, -2.25), std::pow(3.0, -2.25), 1e-14);
}

TEST(Exact, RoundingGoesAwayFromZeroAtHalves)
{
    EXPECT_EQ(exact::round(2.5), 3);
    EXPECT_EQ(exact::round(-2.5), -3);
    EXPECT_EQ(exact::floor(-0.5), -1);
    EXPECT_EQ(exact::floor(7.0), 7);
}
