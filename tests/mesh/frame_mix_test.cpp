/// Interpolation in time: exact where it must be, smooth in between.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/mesh/frame_mix.h"

using namespace meshreel;

namespace {

const std::vector<double> uneven{0.0, 0.1, 0.25, 0.3, 0.7, 0.8, 1.2};

/// The value at t of a motion that is f(times[i]) in frame i.
template <class Motion>
double mixed_value(const Timeline& timeline, double t, const Motion& motion)
{
    double sum = 0;
    const FrameMix mix = mix_at(timeline, t);
    for (const FrameMix::Part& part : mix.used()) sum += part.weight * motion(timeline.times_s[part.frame]);
    return sum;
}

double wiggle(double t)
{
    return std::sin(9 * t);
}

} // namespace

TEST(FrameMix, IsTheStoredFrameAtItsTime)
{
    const Timeline timeline{uneven};
    for (std::uint32_t f = 0; f < uneven.size(); ++f) {
        const FrameMix mix = mix_at(timeline, uneven[f]);
        ASSERT_EQ(mix.count, 1u);
        EXPECT_EQ(mix.parts[0].frame, f);
        EXPECT_EQ(mix.parts[0].weight, 1.0);
    }
}

TEST(FrameMix, MovesQuadraticMotionAsItWasAtUnevenTimes)
{
    const auto motion = [](double t) { return 3 - 2 * t + 5 * t * t; };
    for (double t = 0; t <= 1.2; t += 0.01) EXPECT_NEAR(mixed_value({uneven}, t, motion), motion(t), 1e-12);
}

TEST(FrameMix, HasOneSpeedOnBothSidesOfAFrame)
{
    constexpr double h = 1e-5;
    for (double t : {0.1, 0.25, 0.3, 0.7, 0.8}) {
        const double here = wiggle(t);
        const double before = (here - mixed_value({uneven}, t - h, wiggle)) / h;
        const double after = (mixed_value({uneven}, t + h, wiggle) - here) / h;
        EXPECT_NEAR(before, after, 0.02);
    }
}

TEST(FrameMix, OfALoopGoesOnOverTheEnd)
{
    Metadata meta;
    meta.loop = true;
    const std::vector<double> times = uniform_times(20, 20);
    const Timeline timeline = timeline_of(times, meta);
    EXPECT_DOUBLE_EQ(timeline.period_s, 1.0);
    const auto wave = [](double t) { return std::cos(2 * M_PI * t); };
    EXPECT_NEAR(mixed_value(timeline, 0.975, wave), wave(0.975), 1e-3);
    EXPECT_EQ(mix_at(timeline, 1.0).parts[0].frame, 0u);
}

TEST(FrameMix, OfTwoFramesIsAStraightLineAndOfOneThatFrame)
{
    const std::vector<double> two{1.0, 3.0}, one{2.0};
    EXPECT_NEAR(mixed_value({two}, 1.5, [](double t) { return 4 * t; }), 6.0, 1e-12);
    EXPECT_EQ(mix_at({one}, 2.5).count, 1u);
}

TEST(FrameMix, StaysInTheNeighbourhoodWhereTimesAreExtremelyUneven)
{
    const std::vector<double> times{0.0, 1e-300, 1.0, 1.0 + 1e-12, 1e300};
    for (double t : {1e-301, 0.5, 1.0 + 5e-13, 3.0, 1e299}) {
        double sum = 0;
        const FrameMix mix = mix_at({times}, t);
        for (const FrameMix::Part& part : mix.used()) {
            EXPECT_LE(std::abs(part.weight), 16.0);
            sum += part.weight;
        }
        EXPECT_NEAR(sum, 1.0, 1e-9);
    }
}

TEST(Times, BetweenTwoFramesAreThatFarApartAndTakeInBothEnds)
{
    const std::vector<double> times = uniform_times(26, 25);
    const auto sixty = times_between({times}, {0, 25}, 60, 1000);
    ASSERT_TRUE(sixty.ok());
    EXPECT_EQ(sixty->size(), 61u);
    EXPECT_EQ((*sixty)[60], times[25]);
    EXPECT_EQ((*sixty)[12], times[5]);
    EXPECT_EQ(times_between({times}, {5, 10}, 50, 1000)->size(), 11u);
    EXPECT_EQ(times_between({times}, {0, 25}, 60, 60).error().code, ErrorCode::usage);
}

TEST(Times, OfALoopEndBeforeTheFirstFrameComesAgain)
{
    Metadata meta;
    meta.loop = true;
    meta.fps = 25;
    const std::vector<double> times = uniform_times(25, 25);
    EXPECT_EQ(times_between(timeline_of(times, meta), {0, 24}, 60, 1000)->size(), 60u);
}
