/// What every row of the registry of metrics promises.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/metric.h"

using namespace meshreel;

namespace {

using Change = std::function<std::array<double, 3>(std::array<double, 3>)>;

Animation changed(Animation animation, const Change& change)
{
    for (std::size_t i = 0; i < animation.positions.size(); i += 3) {
        float* p = animation.positions.data() + i;
        const auto moved = change({p[0], p[1], p[2]});
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(moved[axis]);
    }
    return animation;
}

/// Coordinates on a grid of 2^-14, so that small whole shifts lose nothing.
Animation coarse(const Animation& animation)
{
    return changed(animation, [](std::array<double, 3> p) {
        for (double& x : p) x = static_cast<double>(exact::round(x * 16384.0)) / 16384.0;
        return p;
    });
}

Animation noisy(const Animation& animation, double amplitude)
{
    Random random(5);
    return coarse(changed(animation, [&](std::array<double, 3> p) {
        for (double& x : p) x += random.uniform(-amplitude, amplitude);
        return p;
    }));
}

std::array<double, 3> shifted(std::array<double, 3> p)
{
    return {p[0] + 5, p[1] - 3, p[2] + 2};
}
std::array<double, 3> halved(std::array<double, 3> p)
{
    return {0.5 * p[0], 0.5 * p[1], 0.5 * p[2]};
}
std::array<double, 3> turned(std::array<double, 3> p) // by the angle whose cosine is 0.6, about two axes
{
    p = {0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1], p[2]};
    return {p[0], 0.6 * p[1] - 0.8 * p[2], 0.8 * p[1] + 0.6 * p[2]};
}

class EveryMetric : public testing::TestWithParam<metrics::Metric> {
protected:
    double measure(const Animation& a, const Animation& b) const { return GetParam().measure(a, b, Threads{1}); }
    void expect_invariant(const Change& change, double tolerance) const
    {
        for (const auto& [name, shape] : test_shapes::all()) {
            const Animation original = coarse(shape), distorted = noisy(shape, 0.05);
            const double before = measure(original, distorted),
                         after = measure(changed(original, change), changed(distorted, change));
            EXPECT_NEAR(after / before, 1.0, tolerance) << name;
        }
    }
};

} // namespace

TEST_P(EveryMetric, HasItsPerfectValueForEqualAnimationsExactly)
{
    for (const auto& [name, animation] : test_shapes::all())
        EXPECT_EQ(measure(animation, animation), GetParam().equal) << name;
}

TEST_P(EveryMetric, SeesNoise)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        EXPECT_NE(measure(animation, noisy(animation, 0.05)), GetParam().equal) << name;
        EXPECT_TRUE(std::isfinite(measure(animation, noisy(animation, 0.05)))) << name;
    }
}

TEST_P(EveryMetric, IsWorseForMoreNoise)
{
    const double sign = GetParam().equal == 0.0 ? 1.0 : -1.0;
    for (const auto& [name, animation] : test_shapes::all())
        EXPECT_GT(sign * measure(animation, noisy(animation, 0.08)), sign * measure(animation, noisy(animation, 0.01)))
            << name;
}

TEST_P(EveryMetric, IsInvariantUnderWhatItPromises)
{
    if (GetParam().invariance.translation) expect_invariant(shifted, 1e-9);
    if (GetParam().invariance.scale) expect_invariant(halved, 1e-12);
    if (GetParam().invariance.rotation) expect_invariant(turned, 1e-4);
}

TEST_P(EveryMetric, GivesTheSameForAnyNumberOfThreads)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const Animation distorted = noisy(animation, 0.05);
        EXPECT_EQ(GetParam().measure(animation, distorted, Threads{1}),
                  GetParam().measure(animation, distorted, Threads{4}))
            << name;
    }
}

TEST_P(EveryMetric, IsFoundByItsName)
{
    ASSERT_NE(metrics::find(GetParam().name), nullptr);
    EXPECT_EQ(metrics::find(GetParam().name)->measure, GetParam().measure);
    EXPECT_FALSE(GetParam().title.empty() || GetParam().source.empty());
}

TEST_P(EveryMetric, IsDefinedForASinglePoint)
{
    Animation point;
    point.vertex_count = 1;
    point.positions = {1, 2, 3, 1, 2, 3};
    point.times_s = {0.0, 1.0};
    Animation moved = point;
    moved.positions[3] = 4;
    EXPECT_EQ(measure(point, point), GetParam().equal);
    EXPECT_FALSE(std::isnan(measure(point, moved)));
    EXPECT_NE(measure(point, moved), GetParam().equal);
}

INSTANTIATE_TEST_SUITE_P(Metrics, EveryMetric, testing::ValuesIn(metrics::all().begin(), metrics::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Metrics, OfAShiftAreKnownInClosedForm)
{
    // Two frames of the points (-1, 0, 0), (1, 0, 0): spread 1 about the centroid, body diagonal 2; all moved by 0.25.
    Animation original;
    original.vertex_count = 2;
    original.positions = {-1, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0};
    original.times_s = {0.0, 1.0};
    const Animation moved = changed(original, [](std::array<double, 3> p) {
        return std::array{p[0], p[1] + 0.25, p[2]};
    });
    const auto value = [&](const char* name) { return metrics::find(name)->measure(original, moved, Threads{1}); };
    EXPECT_DOUBLE_EQ(value("kg"), 25.0);
    EXPECT_DOUBLE_EQ(value("rms"), 0.25);
    EXPECT_DOUBLE_EQ(value("max_error"), 0.25);
    EXPECT_DOUBLE_EQ(value("max_error_relative"), 12.5);
    EXPECT_DOUBLE_EQ(value("psnr"), 10.0 * std::log10(64.0));
    EXPECT_DOUBLE_EQ(value("sted"), 0.0);
    EXPECT_EQ(metrics::find("no such metric"), nullptr);
}

TEST(Metrics, WhatCannotBeComparedIsSaid)
{
    const Animation torus = test_shapes::torus();
    Animation other = torus;
    EXPECT_TRUE(metrics::comparable(torus, other).ok());
    std::swap(other.triangles[4][0], other.triangles[4][1]);
    EXPECT_EQ(metrics::comparable(torus, other).error().message, "triangle 4 is another one in the other animation");
    other.triangles.pop_back();
    EXPECT_EQ(metrics::comparable(torus, other).error().field, "triangles");
    other.times_s.pop_back();
    EXPECT_EQ(metrics::comparable(torus, other).error().field, "frame_count");
    other.vertex_count -= 1;
    EXPECT_EQ(metrics::comparable(torus, other).error().field, "vertex_count");
}
