/// What every row of the registry of metrics promises.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/measure.h"

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

/// Shapes on which every measure has something to see: a surface that moves.
std::vector<test_shapes::Named> moving_surfaces()
{
    std::vector<test_shapes::Named> shapes = test_shapes::all();
    std::erase_if(shapes, [](const test_shapes::Named& shape) {
        return shape.animation.triangles.empty() || shape.animation.frame_count() < 2;
    });
    return shapes;
}

class EveryMetric : public testing::TestWithParam<metrics::Metric> {
protected:
    /// One number for each value of the metric.
    std::vector<double> measure(const Animation& a, const Animation& b, unsigned threads = 1) const
    {
        return metrics::measure(a, b, metrics::Wanted{&GetParam()}, {Threads{threads}})->values;
    }
    void expect_equal(const std::vector<double>& found, const std::string& name) const
    {
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_EQ(found[i], GetParam().values[i].equal) << GetParam().values[i].name << " " << name;
    }
    void expect_numbers(const std::vector<double>& found) const
    {
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_FALSE(std::isnan(found[i])) << GetParam().values[i].name;
    }
    /// Those values stay that promise to.
    void expect_invariant(const Change& change, bool metrics::Invariance::*promise, double tolerance) const
    {
        for (const auto& [name, shape] : test_shapes::all()) {
            const Animation original = coarse(shape), distorted = noisy(shape, 0.05);
            const std::vector<double> before = measure(original, distorted),
                                      after = measure(changed(original, change), changed(distorted, change));
            for (std::size_t i = 0; i < before.size(); ++i)
                EXPECT_TRUE(!(GetParam().values[i].invariance.*promise) || before[i] == after[i] ||
                            std::abs(after[i] / before[i] - 1.0) <= tolerance)
                    << GetParam().values[i].name << " " << name << ": " << before[i] << ", then " << after[i];
        }
    }
};

} // namespace

TEST_P(EveryMetric, HasItsPerfectValuesForEqualAnimationsExactly)
{
    for (const auto& [name, animation] : test_shapes::all()) expect_equal(measure(animation, animation), name);
}

TEST_P(EveryMetric, SeesNoise)
{
    for (const auto& [name, animation] : moving_surfaces()) {
        const std::vector<double> found = measure(animation, noisy(animation, 0.05));
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_TRUE(std::isfinite(found[i]) && found[i] != GetParam().values[i].equal)
                << GetParam().values[i].name << " " << name << ": " << found[i];
    }
}

TEST_P(EveryMetric, IsDefinedWithoutTrianglesAndForASingleFrame)
{
    for (const Animation& animation : {test_shapes::points_only(), test_shapes::one_frame()})
        expect_numbers(measure(animation, noisy(animation, 0.05)));
}

TEST_P(EveryMetric, IsWorseForMoreNoise)
{
    for (const auto& [name, animation] : moving_surfaces()) {
        const std::vector<double> much = measure(animation, noisy(animation, 0.08)),
                                  little = measure(animation, noisy(animation, 0.01));
        for (std::size_t i = 0; i < much.size(); ++i)
            EXPECT_TRUE(GetParam().values[i].better == metrics::Better::less ? much[i] > little[i]
                                                                             : much[i] < little[i])
                << GetParam().values[i].name << " " << name;
    }
}

TEST_P(EveryMetric, IsInvariantUnderWhatItPromises)
{
    expect_invariant(shifted, &metrics::Invariance::translation, 1e-9);
    expect_invariant(halved, &metrics::Invariance::scale, 1e-12);
    expect_invariant(turned, &metrics::Invariance::rotation, 1e-4);
}

TEST_P(EveryMetric, GivesTheSameForAnyNumberOfThreads)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const Animation distorted = noisy(animation, 0.05);
        EXPECT_EQ(measure(animation, distorted, 1), measure(animation, distorted, 4)) << name;
    }
}

TEST_P(EveryMetric, IsFoundByItsNameAndByThoseOfItsValues)
{
    EXPECT_EQ(metrics::find(GetParam().name)->start, GetParam().start);
    for (std::size_t i = 0; i < GetParam().values.size(); ++i) {
        const metrics::FoundValue found = metrics::find_value(GetParam().values[i].name);
        EXPECT_EQ(found.metric, metrics::find(GetParam().name));
        EXPECT_EQ(found.index, i);
    }
}

TEST_P(EveryMetric, IsDefinedForASinglePoint)
{
    Animation point;
    point.vertex_count = 1;
    point.positions = {1, 2, 3, 1, 2, 3};
    point.times_s = {0.0, 1.0};
    Animation moved = point;
    moved.positions[3] = 4;
    expect_equal(measure(point, point), "a point");
    expect_numbers(measure(point, moved));
}

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
    const auto value = [&](const char* name) { return *metrics::measured(name, original, moved); };
    EXPECT_DOUBLE_EQ(value("kg"), 25.0);
    EXPECT_DOUBLE_EQ(value("rms"), 0.25);
    EXPECT_DOUBLE_EQ(value("max_error"), 0.25);
    EXPECT_DOUBLE_EQ(value("max_error_relative"), 12.5);
    EXPECT_DOUBLE_EQ(value("psnr"), 10.0 * std::log10(64.0));
    EXPECT_DOUBLE_EQ(value("mse"), 1.0 / 16.0);
    EXPECT_DOUBLE_EQ(value("psnr_thesis"), 20.0 * std::log10(1.0 / 64.0));
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

TEST(Metrics, WhatNeedsNoCounterpartNeedsNoEqualVertices)
{
    Animation other = test_shapes::torus();
    other.vertex_count -= 1;
    EXPECT_TRUE(metrics::comparable(test_shapes::torus(), other, metrics::Common::frames).ok());
    other.times_s.pop_back();
    EXPECT_EQ(metrics::comparable(test_shapes::torus(), other, metrics::Common::frames).error().field, "frame_count");
    EXPECT_TRUE(metrics::comparable(test_shapes::torus(), other, metrics::Common::nothing).ok());
}

TEST(Metrics, AMeasureThatNeedsCounterpartsSaysSo)
{
    const auto result = metrics::measured("kg", test_shapes::torus(), test_shapes::tetrahedron());
    EXPECT_TRUE(result.error().message.starts_with("kg needs each vertex' counterpart in the other animation: "));
}

TEST(Metrics, ParametersAreSetByNameWithinTheirRange)
{
    const metrics::Metric& sted = *metrics::find("sted");
    std::vector<double> parameters = metrics::usual_parameters(sted);
    EXPECT_TRUE(metrics::set_parameter(sted, "window", 3, parameters).ok());
    EXPECT_EQ(parameters[1], 3.0);
    for (const double wrong : {0.0, 2.5, std::nan("")})
        EXPECT_EQ(metrics::set_parameter(sted, "window", wrong, parameters).error().code, ErrorCode::usage);
    EXPECT_EQ(metrics::set_parameter(sted, "windw", 3, parameters).error().code, ErrorCode::usage);
}

TEST_P(EveryMetric, TellsErrorsOfVerticesAndFramesAsItPromises)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        std::size_t told = 0;
        metrics::Wanted wanted{&GetParam()};
        wanted.vertex_errors = [&](std::size_t frame, std::span<const double> errors) {
            EXPECT_EQ(frame, told++);
            EXPECT_EQ(errors.size(), animation.vertex_count);
            for (const double error : errors) EXPECT_TRUE(error >= 0.0 && std::isfinite(error));
        };
        const auto measured = metrics::measure(animation, noisy(animation, 0.05), wanted);
        EXPECT_EQ(told, GetParam().vertex_title.empty() ? 0 : animation.frame_count()) << name;
        EXPECT_TRUE(measured->per_frame.empty() || measured->per_frame.size() == animation.frame_count()) << name;
    }
}

TEST_P(EveryMetric, SaysTheSameHoweverFramesAreCut)
{
    const Animation original = test_shapes::torus(), distorted = noisy(original, 0.05);
    const metrics::Wanted wanted{&GetParam()};
    const metrics::Measured whole = *metrics::measure(original, distorted, wanted);
    for (const std::size_t length : {1u, 3u, 5u}) {
        const auto cut = GetParam().start({GetParam(), original, distorted, wanted.parameters, Threads{1}, {}});
        for (std::size_t f = 0; f < original.frame_count(); f += length) {
            const std::size_t rows = std::min(length, original.frame_count() - f), cols = 3ul * original.vertex_count;
            cut->add({{original.frame(f).data(), rows, cols}, {distorted.frame(f).data(), rows, cols}});
        }
        EXPECT_EQ(cut->finish({}), whole.values) << length;
        EXPECT_EQ(cut->per_frame(), whole.per_frame) << length;
    }
}

INSTANTIATE_TEST_SUITE_P(Metrics, EveryMetric, testing::ValuesIn(metrics::all().begin(), metrics::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });
