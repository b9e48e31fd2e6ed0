/// The search on a made rate-distortion surface with a known best point.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/tune/search.h"

using namespace meshreel;

namespace {

/// Distortion grows with the step and falls with K; size grows as the step shrinks and with K.
Result<tune::Attempt> model(const codecs::Settings& wanted)
{
    codecs::Settings settings = wanted;
    if (!settings.bases)
        settings.bases = static_cast<std::uint32_t>(4.0 / (settings.truncation * std::sqrt(settings.step)));
    const double K = *settings.bases;
    const double distortion = std::hypot(settings.step * std::sqrt(K) * 0.3, 2.0 / (K * K));
    const double bits = K * (10.0 + std::log2(1.0 / settings.step)) * 1000.0;
    return tune::Attempt{settings, static_cast<std::uint64_t>(bits), distortion};
}

tune::Problem problem(double target)
{
    return {model, target, {0.65}, true, {}};
}

} // namespace

TEST(Search, EndsCloseBelowTheTarget)
{
    for (double target : {0.3, 0.1, 0.01, 0.001}) {
        const auto best = tune::smallest(problem(target), {.step = 1.0});
        ASSERT_TRUE(best.ok());
        EXPECT_LE(best->distortion, target);
        EXPECT_GE(best->distortion, 0.97 * target);
    }
}

TEST(Search, FindsASmallerFileThanTheFirstGuessOfBases)
{
    tune::Problem rough = problem(0.01);
    rough.refine = false;
    EXPECT_LT(tune::smallest(problem(0.01), {.step = 1.0})->size, tune::smallest(rough, {.step = 1.0})->size);
}

TEST(Search, SaysSoWhenNoStepReachesTheTarget)
{
    tune::Problem stuck = problem(0.01);
    stuck.attempt = [](const codecs::Settings& settings) -> Result<tune::Attempt> {
        tune::Attempt attempt{settings, 100, 1.0};
        attempt.settings.bases = 3;
        return attempt;
    };
    const auto best = tune::smallest(stuck, {.step = 1.0});
    ASSERT_FALSE(best.ok());
    EXPECT_EQ(best.error().code, ErrorCode::missed);
}

TEST(Search, HandsOnTheErrorOfAnAttempt)
{
    tune::Problem broken = problem(0.01);
    broken.attempt = [](const codecs::Settings&) -> Result<tune::Attempt> { return bad_input("no good"); };
    EXPECT_EQ(tune::smallest(broken, {.step = 1.0}).error().message, "no good");
}
