/// Coefficients of correlation agree with their definitions, and know when there is nothing to say.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <vector>

#include "meshreel/base/random.h"
#include "meshreel/metrics/correlation.h"

using namespace meshreel;
using metrics::Correlation;
using Numbers = std::vector<double>;

namespace {

Numbers random_numbers(std::size_t count, std::uint64_t seed, std::uint64_t different)
{
    Random random(seed);
    Numbers numbers(count);
    for (double& number : numbers) number = static_cast<double>(random.below(different));
    return numbers;
}

int sign(double x)
{
    return (x > 0) - (x < 0);
}

/// Tau-b as it is defined: all pairs.
double tau_of_all_pairs(const Numbers& x, const Numbers& y)
{
    double agreement = 0, untied_x = 0, untied_y = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            agreement += sign(x[i] - x[j]) * sign(y[i] - y[j]);
            untied_x += x[i] != x[j];
            untied_y += y[i] != y[j];
        }
    return agreement / std::sqrt(untied_x * untied_y);
}

class EveryCoefficient : public testing::TestWithParam<metrics::Coefficient> {
protected:
    Correlation of(const Numbers& x, const Numbers& y) const { return GetParam().of(x, y); }
};

} // namespace

TEST_P(EveryCoefficient, IsOneOnARisingLineAndMinusOneOnAFallingOne)
{
    const Numbers x{1, 2, 4, 7, 11}, rising{12, 14, 18, 24, 32}, falling{9, 8, 6, 3, -1};
    EXPECT_NEAR(*of(x, rising).value, 1.0, 1e-15);
    EXPECT_NEAR(*of(x, falling).value, -1.0, 1e-15);
    EXPECT_NEAR(of(x, rising).interval->low, 1.0, 1e-6);
}

TEST_P(EveryCoefficient, IsTheSameWhenBothListsAreSwappedScaledOrShifted)
{
    const Numbers x = random_numbers(40, 1, 12), y = random_numbers(40, 2, 12);
    Numbers other = y;
    for (double& value : other) value = 8 * value + 3;
    EXPECT_NEAR(*of(x, y).value, *of(y, x).value, 1e-15);
    EXPECT_NEAR(*of(x, y).value, *of(x, other).value, 1e-14);
}

TEST_P(EveryCoefficient, SaysWhyThereIsNone)
{
    const Numbers three{1, 2, 5}, flat{4, 4, 4};
    EXPECT_EQ(of({1, 2}, {2, 1}).lacking, "fewer than 3 pairs");
    EXPECT_EQ(of({}, {}).lacking, "fewer than 3 pairs");
    EXPECT_EQ(of(flat, three).lacking, "the measure is constant");
    EXPECT_EQ(of(three, flat).lacking, "the score is constant");
    EXPECT_FALSE(of(flat, three).value || of(flat, three).interval);
    EXPECT_TRUE(of(three, three).value);
    EXPECT_EQ(of(three, three).lacking, "too few pairs for an interval");
}

TEST_P(EveryCoefficient, HasAnIntervalAroundItThatMorePairsMakeShorter)
{
    for (const std::size_t n : {5, 9, 100}) {
        const Numbers x = random_numbers(n, 3, 1000), y = random_numbers(n, 4, 1000);
        const Correlation once = of(x, y);
        Numbers xx = x, yy = y;
        xx.insert(xx.end(), x.begin(), x.end());
        yy.insert(yy.end(), y.begin(), y.end());
        const Correlation twice = of(xx, yy);
        EXPECT_LT(once.interval->low, *once.value);
        EXPECT_GT(once.interval->high, *once.value);
        EXPECT_LT(twice.interval->high - twice.interval->low, once.interval->high - once.interval->low);
    }
}

TEST_P(EveryCoefficient, IsNeverANanHoweverLargeSmallOrCloseTheNumbersAre)
{
    const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
    const Numbers usual{1, 3, 2, 5}, wide{-most, most, 0, most}, tiny{0, least, 0, least};
    const Numbers close{1, 1, std::nextafter(1.0, 2.0), 1};
    for (const Numbers& x : {wide, tiny, close})
        for (const Numbers& y : {wide, tiny, close, usual}) {
            const Correlation correlation = of(x, y);
            ASSERT_TRUE(correlation.value);
            EXPECT_LE(std::abs(*correlation.value), 1.0); // false for a NaN
        }
}

INSTANTIATE_TEST_SUITE_P(All, EveryCoefficient,
                         testing::ValuesIn(metrics::coefficients().begin(), metrics::coefficients().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Correlation, OfPearsonIsTheCosineOfWhatIsLeftOnceTheMeansAreOut)
{
    EXPECT_NEAR(*metrics::pearson(Numbers{-1, 0, 1}, Numbers{7, 4, 7}).value, 0.0, 1e-15);
    EXPECT_NEAR(*metrics::pearson(Numbers{0, 0, 3}, Numbers{0, 3, 3}).value, 0.5, 1e-15);
}

TEST(Correlation, OfSpearmanIsThatOfATextbook) // hours of television and IQ: 1 - 6 * 194 / 990
{
    const Numbers iq{106, 100, 86, 101, 99, 103, 97, 113, 112, 110}, hours{7, 27, 2, 50, 28, 29, 20, 12, 6, 17};
    EXPECT_NEAR(*metrics::spearman(iq, hours).value, -29.0 / 165.0, 1e-15);
}

TEST(Correlation, OfSpearmanGivesEqualValuesTheMeanOfTheirRanks)
{
    const Numbers x{10, 20, 20, 30}, y{1, 2, 3, 4};
    EXPECT_EQ(*metrics::spearman(x, y).value, *metrics::pearson(Numbers{1, 2.5, 2.5, 4}, y).value);
}

TEST(Correlation, OfKendallCountsPairsInEitherOrderTiesOrNot)
{
    for (const std::uint64_t different : {2, 5, 1000000})
        for (const std::size_t n : {9, 17, 64}) {
            const Numbers x = random_numbers(n, n + 7, different), y = random_numbers(n, n + 8, different);
            const Correlation tau = metrics::kendall(x, y);
            ASSERT_TRUE(tau.value);
            EXPECT_NEAR(*tau.value, tau_of_all_pairs(x, y), 1e-14);
        }
    EXPECT_EQ(*metrics::kendall(Numbers{1, 2, 3, 4}, Numbers{1, 3, 2, 4}).value, 4.0 / 6.0);
}

TEST(Correlation, HasTheIntervalsOfTheirAuthors)
{
    Numbers x(28), y(28); // r = 1/2: pairs (0, 0), (0, 3), (3, 3) and again
    for (std::size_t i = 0; i < 27; ++i) {
        x[i] = i % 3 == 2 ? 3 : 0;
        y[i] = i % 3 == 0 ? 0 : 3;
    }
    x[27] = 1, y[27] = 2; // both means: nothing changes
    const Correlation r = metrics::pearson(x, y);
    EXPECT_NEAR(*r.value, 0.5, 1e-15);
    EXPECT_NEAR(r.interval->low, std::tanh(std::atanh(0.5) - 1.959963984540054 / 5), 1e-14); // sqrt(28 - 3)
    EXPECT_NEAR(r.interval->high, std::tanh(std::atanh(0.5) + 1.959963984540054 / 5), 1e-14);
    const Correlation s = metrics::spearman(x, y), t = metrics::kendall(x, y);
    EXPECT_NEAR(std::atanh(s.interval->high) - std::atanh(*s.value),
                1.959963984540054 * std::sqrt((1 + *s.value * *s.value / 2) / 25), 1e-13);
    EXPECT_NEAR(std::atanh(*t.value) - std::atanh(t.interval->low), 1.959963984540054 * std::sqrt(0.437 / 24), 1e-13);
}

TEST(Correlation, CountsAMillionPairsAtOnce)
{
    Numbers x(1000000);
    std::iota(x.begin(), x.end(), 0.0);
    EXPECT_EQ(*metrics::kendall(x, x).value, 1.0);
}
