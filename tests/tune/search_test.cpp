/// The search on a made rate-distortion surface with a known best point.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/tune/search.h"

using namespace meshreel;

namespace {

/// Distortion grows with the step and falls with K, which the truncation decides; size grows as the step shrinks and
/// with K.
struct Model {
    double target = 0.01;
    double bias = 1.0; ///< verified excess over the attempt's
    bool limits_size = false;
    int attempts = 0, verifications = 0;

    Result<tune::Attempt> attempt(const codecs::Settings& settings)
    {
        ++attempts;
        const double K = 4.0 / (settings.truncation * std::sqrt(settings.step));
        const double distortion = std::hypot(settings.step * std::sqrt(K) * 0.3, 2.0 / (K * K));
        const double bits = K * (10.0 + std::log2(1.0 / settings.step)) * 1000.0;
        tune::Attempt result;
        result.settings = settings;
        result.excess = (limits_size ? bits : distortion) / target;
        result.cost = limits_size ? distortion : bits;
        return result;
    }
    tune::Problem problem()
    {
        return {[this](const codecs::Settings& settings) { return attempt(settings); },
                [this](const tune::Attempt& attempt) {
                    ++verifications;
                    return Result<double>(bias * Model(*this).attempt(attempt.settings)->excess);
                },
                !limits_size};
    }
};

const tune::Knob truncation{&codecs::Settings::truncation, 1.3, 0.01, 10.0};

} // namespace

TEST(Search, EndsCloseBelowTheTarget)
{
    for (double target : {0.3, 0.1, 0.01, 0.001}) {
        Model model{.target = target};
        const auto best = tune::cheapest(model.problem(), {.step = 1.0});
        ASSERT_TRUE(best.ok());
        EXPECT_LE(best->excess, 1.0);
        EXPECT_GE(best->excess, 0.97);
    }
}

TEST(Search, FillsASizeAsWell)
{
    Model model{.target = 200'000, .limits_size = true};
    const auto best = tune::cheapest(model.problem(), {.step = 1.0});
    ASSERT_TRUE(best.ok());
    EXPECT_LE(best->excess, 1.0);
    EXPECT_GE(best->excess, 0.97);
}

TEST(Search, NeedsFewAttemptsFromAFairGuess)
{
    Model model;
    const auto best = tune::cheapest(model.problem(), {.step = 0.02});
    ASSERT_TRUE(best.ok());
    EXPECT_LE(model.attempts, 5);
    EXPECT_EQ(model.verifications, 1);
}

TEST(Search, TakesVerificationForTheTruth)
{
    for (double bias : {0.9, 1.1}) {
        Model model{.bias = bias};
        const auto best = tune::cheapest(model.problem(), {.step = 1.0});
        ASSERT_TRUE(best.ok());
        const double truth = bias * model.attempt(best->settings)->excess;
        EXPECT_LE(truth, 1.0);
        EXPECT_GE(truth, 0.97);
    }
}

TEST(Search, FindsASmallerFileWithAKnobThanWithout)
{
    Model plain, varied;
    tune::Problem problem = varied.problem();
    problem.knobs = {truncation};
    problem.rounds = 3;
    const codecs::Settings far_off{.step = 0.02, .truncation = 3.0};
    EXPECT_LT(tune::cheapest(problem, far_off)->cost, 0.98 * tune::cheapest(plain.problem(), far_off)->cost);
}

TEST(Search, RenewsWeightsOftenerOnlyWhereThatPays)
{
    const auto growth_found = [](double dearer, int rounds) { // a growth of 1 costs so many times what 2 does
        Model model;
        tune::Problem problem = model.problem();
        problem.attempt = [&](const codecs::Settings& settings) {
            Result<tune::Attempt> attempt = model.attempt(settings);
            attempt->cost *= settings.growth == 1 ? dearer : 1.0;
            return attempt;
        };
        problem.knobs = {truncation};
        problem.rounds = rounds;
        return tune::cheapest(problem, {.step = 0.02, .growth = 2})->settings.growth;
    };
    EXPECT_EQ(growth_found(0.99, 2), 1u);
    EXPECT_EQ(growth_found(0.9999, 2), 2u);
    EXPECT_EQ(growth_found(1.01, 2), 2u);
    EXPECT_EQ(growth_found(0.5, 1), 2u);
}

TEST(Search, SaysSoWhenNoStepReachesTheTarget)
{
    Model model;
    tune::Problem stuck = model.problem();
    stuck.attempt = [](const codecs::Settings& settings) -> Result<tune::Attempt> {
        EXPECT_TRUE(settings.step > 0 && std::isfinite(settings.step));
        return tune::Attempt{settings, 100.0, 1.0, {}, 3, 1.0, {}};
    };
    const auto best = tune::cheapest(stuck, {.step = 1.0});
    ASSERT_FALSE(best.ok());
    EXPECT_EQ(best.error().code, ErrorCode::missed);
}

TEST(Search, CrossesAPlateauThatIsJustTooHigh)
{
    Model model;
    tune::Problem problem = model.problem();
    problem.attempt = [](const codecs::Settings& settings) -> Result<tune::Attempt> {
        return tune::Attempt{settings, settings.step > 1e-4 ? 1.003 : 0.5, 1.0, {}, 3, 1.0, {}};
    };
    problem.verify = [](const tune::Attempt& attempt) { return Result<double>(attempt.excess); };
    EXPECT_TRUE(tune::cheapest(problem, {.step = 1.0}).ok());
}

TEST(Search, HandsOnTheErrorOfAnAttempt)
{
    Model model;
    tune::Problem broken = model.problem();
    broken.attempt = [](const codecs::Settings&) -> Result<tune::Attempt> { return bad_input("no good"); };
    EXPECT_EQ(tune::cheapest(broken, {.step = 1.0}).error().message, "no good");
}

TEST(Search, MendsWhatMissesTheLimitByALittle)
{
    Model model;
    tune::Problem problem = model.problem();
    problem.verify = [](const tune::Attempt& attempt) { return Result<double>(attempt.excess); };
    problem.mend = [](tune::Attempt attempt) {
        attempt.excess = 0.985;
        return Result<tune::Attempt>(std::move(attempt));
    };
    const Result<tune::Attempt> found = tune::cheapest(problem, {.step = 0.01});
    ASSERT_TRUE(found.ok());
    EXPECT_LE(found->excess, 1.0);
    EXPECT_GE(found->excess, 0.97);
}

TEST(Search, KeepsLengthsOnlyWhereRelaxingPaysAndWhereThatSavesMore)
{
    struct Case {
        double relaxed, kept; ///< what the size is multiplied by
        bool relax, lengths;  ///< in what is found
    };
    for (const Case& c : {Case{0.9, 0.9, true, true}, {0.9, 0.99, true, false}, {0.99, 0.5, false, false}}) {
        Model model;
        tune::Problem problem = model.problem();
        problem.attempt = [&](const codecs::Settings& settings) {
            Result<tune::Attempt> attempt = model.attempt(settings);
            attempt->cost *= (settings.relax ? c.relaxed : 1.0) * (settings.lengths ? c.kept : 1.0);
            return attempt;
        };
        problem.knobs = {truncation};
        problem.spread = 0;
        const auto best = tune::cheapest(problem, {.step = 0.02});
        ASSERT_TRUE(best.ok());
        EXPECT_EQ(best->settings.relax, c.relax);
        EXPECT_EQ(best->settings.lengths, c.lengths);
    }
}
