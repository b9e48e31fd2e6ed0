/// Numbers counted in rising order.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "meshreel/base/random.h"
#include "meshreel/coding/number_line.h"

using namespace meshreel;
using coding::NumberLine;

namespace {

NumberLine decimals(std::uint8_t digits, std::uint8_t decimals, double scale = 1.0, double offset = 0.0)
{
    return {true, scale, offset, digits, decimals};
}

const NumberLine lines[] = {{},
                            decimals(6, 6),
                            decimals(15, 4),
                            decimals(3, 10),
                            decimals(6, 16, 1.676881507),
                            decimals(15, 0, 0.125, -3.5),
                            decimals(2, 3, -0.3)};

} // namespace

TEST(NumberLine, CountsAllFloatsInTheirOrder)
{
    const float values[] = {-std::numeric_limits<float>::max(), -1.0f, -1e-45f, -0.0f, 0.0f, 1e-45f, 1.0f, 3e38f};
    for (std::size_t i = 0; i < std::size(values); ++i) {
        const float back = coding::float_at(coding::float_place(values[i]));
        EXPECT_EQ(back, values[i]);
        EXPECT_EQ(std::signbit(back), std::signbit(values[i]));
        if (i > 0) {
            EXPECT_LT(coding::float_place(values[i - 1]), coding::float_place(values[i]));
        }
    }
}

TEST(NumberLine, HasTheNumbersThatATextOfSixDigitsHas)
{
    const NumberLine line = decimals(6, 12);
    for (const float x : {0.0f, 1.5f, 123.456f, 0.00123456f, -98765.4f, 1e-7f, 1.23457e+20f, 1e-12f})
        EXPECT_EQ(line.at(line.nearest(static_cast<double>(x))), x);
    EXPECT_NE(line.at(line.nearest(1.2345678)), 1.2345678f);
}

TEST(NumberLine, RisesWithItsNumbers)
{
    for (const NumberLine& line : lines)
        for (std::int64_t n = -30000; n < 30000; n += 7) {
            const double step = static_cast<double>(line.at(n + 1)) - static_cast<double>(line.at(n));
            EXPECT_GE(line.scale > 0 ? step : -step, 0.0) << n;
        }
}

TEST(NumberLine, FindsEachOfItsNumbers)
{
    for (const NumberLine& line : lines)
        for (std::int64_t n : {0, 1, -1, 7, 99, 100, -101, 899, 1000, -1001}) {
            const double x = static_cast<double>(line.at(n));
            EXPECT_EQ(line.at(line.nearest(x)), line.at(n)) << n;
            EXPECT_NEAR(line.position(x), static_cast<double>(n), 0.2) << n;
        }
}

TEST(NumberLine, TellsTheDistanceOfNeighbours)
{
    for (const NumberLine& line : lines)
        for (const double x : {0.01, 1.3, -77.0}) {
            const std::int64_t n = line.nearest(x);
            const double there = std::abs(static_cast<double>(line.at(n + 1)) - static_cast<double>(line.at(n)));
            EXPECT_NEAR(line.step(x), there, 0.15 * there) << x;
        }
}

TEST(NumberLine, TakesAnyNumberAndAnyPlace)
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (const NumberLine& line : lines) {
        for (const double x : {0.0, -0.0, 1e300, -1e300, 1e-320, infinity, -infinity, std::nan("")})
            EXPECT_TRUE(std::isfinite(line.at(line.nearest(x)))) << x;
        for (const std::int64_t n :
             {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
            EXPECT_TRUE(std::isfinite(line.at(n)));
    }
}
