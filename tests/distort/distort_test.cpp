/// What every distortion promises, and the closed form of each.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "meshreel/distort/distortion.h"
#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/kg.h"

using namespace meshreel;
using distort::Distortion;
using distort::Request;
using distort::Unit;

namespace {

Animation wave(std::uint32_t vertices = 400, std::uint32_t frames = 20)
{
    return *shapes::generate(*shapes::find("cloth"), {.vertices = vertices, .frames = frames});
}

Animation after(const std::string& name, const Animation& animation, const Request& request)
{
    return *distort::distort(*distort::find(name), animation, request);
}

bool same(const Animation& a, const Animation& b)
{
    return a.positions == b.positions && a.triangles == b.triangles && a.times_s == b.times_s;
}

/// All differences of coordinates: [F x 3V].
std::vector<double> differences(const Animation& a, const Animation& b)
{
    std::vector<double> all;
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        all.push_back(static_cast<double>(b.positions[i]) - a.positions[i]);
    return all;
}

double deviation(const std::vector<double>& values)
{
    double sum = 0, square = 0;
    for (const double x : values) {
        sum += x;
        square += x * x;
    }
    const double n = static_cast<double>(values.size());
    return std::sqrt(square / n - sum * sum / n / n);
}

class EveryDistortion : public testing::TestWithParam<Distortion> {
protected:
    /// A little, and more, of this distortion.
    double amount(int strength) const
    {
        const Distortion& row = GetParam();
        if (row.unit == Unit::length) return 0.01 * strength;
        if (row.unit == Unit::share) return 1.0 / (1 + strength);
        return row.more_is_worse ? 2.0 * strength : 7.0 - 2.0 * strength;
    }
    Animation distorted(const Animation& animation, const Request& request) const
    {
        return *distort::distort(GetParam(), animation, request);
    }
};

} // namespace

TEST_P(EveryDistortion, MakesAValidAnimationOfTheSameTimesFromAnyMesh)
{
    for (const auto& [name, animation] : test_shapes::all())
        for (const int strength : {1, 3}) {
            const auto result = distort::distort(GetParam(), animation, {.amount = amount(strength)});
            ASSERT_TRUE(result.ok()) << name << ": " << result.error().sentence();
            EXPECT_TRUE(validate(*result).ok()) << name << ": " << validate(*result).error().sentence();
            EXPECT_EQ(result->times_s, animation.times_s) << name;
            EXPECT_TRUE(!GetParam().keeps_mesh || result->triangles == animation.triangles) << name;
        }
}

TEST_P(EveryDistortion, ChangesNothingWhereNothingIsAskedFor)
{
    if (!std::isfinite(GetParam().nothing)) GTEST_SKIP() << "no amount of it is nothing";
    const Animation animation = wave();
    EXPECT_TRUE(same(animation, distorted(animation, {.amount = GetParam().nothing})));
}

TEST_P(EveryDistortion, IsTheWorseTheMoreIsAskedFor)
{
    const Animation animation = wave();
    const Animation a = distorted(animation, {.amount = amount(1)}), b = distorted(animation, {.amount = amount(2)}),
                    c = distorted(animation, {.amount = amount(3)});
    if (!GetParam().keeps_mesh) {
        EXPECT_GT(animation.vertex_count, a.vertex_count);
        EXPECT_GT(a.vertex_count, b.vertex_count);
        EXPECT_GT(b.vertex_count, c.vertex_count);
        return;
    }
    const auto kg = [&](const Animation& bad) { return metrics::kg_error(animation, bad, Threads{1}); };
    EXPECT_GT(kg(a), 0.0);
    EXPECT_GT(kg(b), kg(a));
    EXPECT_GT(kg(c), kg(b));
}

TEST_P(EveryDistortion, IsTheSameForAnyNumberOfThreads)
{
    const Animation animation = wave();
    const Animation one = distorted(animation, {.amount = amount(2), .threads = {1}});
    EXPECT_TRUE(same(one, distorted(animation, {.amount = amount(2), .threads = {3}})));
}

TEST_P(EveryDistortion, ListensToItsSeedIfItHasOne)
{
    const Animation animation = wave();
    const Animation first = distorted(animation, {.amount = amount(2), .seed = 1});
    EXPECT_TRUE(same(first, distorted(animation, {.amount = amount(2), .seed = 1})));
    EXPECT_EQ(same(first, distorted(animation, {.amount = amount(2), .seed = 2})), !GetParam().has_seed);
}

TEST_P(EveryDistortion, KeepsDoubledVerticesTogether)
{
    if (!GetParam().keeps_mesh) GTEST_SKIP() << "vertices have other numbers";
    const Animation tube = test_shapes::split_seam(), bad = distorted(tube, {.amount = amount(2)});
    const auto doubled = [&](const Animation& of, std::size_t a, std::size_t b) {
        return std::equal(&of.positions[3 * a], &of.positions[3 * a] + 3, &of.positions[3 * b]);
    };
    std::size_t pairs = 0;
    for (std::size_t a = 0; a < tube.vertex_count; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (!doubled(tube, a, b)) continue;
            ++pairs;
            EXPECT_TRUE(doubled(bad, a, b));
        }
    EXPECT_GT(pairs, 0u);
}

TEST_P(EveryDistortion, RefusesAmountsThatMakeNoSense)
{
    const double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    for (const double bad : {-1.0, none, infinite}) {
        const auto result = distort::distort(GetParam(), test_shapes::torus(), {.amount = bad});
        ASSERT_FALSE(result.ok()) << bad;
        EXPECT_EQ(result.error().code, ErrorCode::usage);
    }
    const auto waved = distort::distort(GetParam(), test_shapes::torus(), {.amount = amount(1), .omega = 2.0});
    EXPECT_EQ(waved.ok(), GetParam().has_omega);
}

INSTANTIATE_TEST_SUITE_P(All, EveryDistortion, testing::ValuesIn(distort::all().begin(), distort::all().end()),
                         [](const auto& row) {
                             std::string name(row.param.name);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Distort, NoiseInVertexAndFrameHasItsDeviationAndIsNormal)
{
    const Animation animation = wave(1000, 20);
    const std::vector<double> noise = differences(animation, after("noise-vertex-frame", animation, {.amount = 0.01}));
    double fourth = 0, beyond = 0;
    for (const double x : noise) {
        fourth += std::pow(x / 0.01, 4) / static_cast<double>(noise.size());
        beyond += std::abs(x) > 0.0196 ? 1.0 / static_cast<double>(noise.size()) : 0.0;
    }
    EXPECT_NEAR(deviation(noise), 0.01, 1e-4); // 60000 numbers: 3.5 standard errors
    EXPECT_NEAR(fourth, 3.0, 0.15);
    EXPECT_NEAR(beyond, 0.05, 0.004);
}

TEST(Distort, NoiseInVerticesStaysThroughAllFramesAndNoiseInFramesOnAllVertices)
{
    const Animation animation = wave(1000, 20);
    const std::vector<double> still = differences(animation, after("noise-vertex", animation, {.amount = 0.01}));
    const std::vector<double> shift = differences(animation, after("noise-frame", animation, {.amount = 0.01}));
    for (std::size_t i = 3000; i < still.size(); ++i) {
        ASSERT_NEAR(still[i], still[i % 3000], 1e-6);
        ASSERT_NEAR(shift[i], shift[i / 3000 * 3000 + i % 3], 1e-6);
    }
    EXPECT_NEAR(deviation({still.begin(), still.begin() + 3000}), 0.01, 5e-4);
    EXPECT_GT(std::abs(shift[0] - shift[3000]), 1e-5);
}

TEST(Distort, NoiseOfASeedIsTheSameOnEveryMachine)
{
    Animation point;
    point.vertex_count = 1;
    point.positions = {0, 0, 0};
    point.times_s = {0};
    const Animation moved = after("noise-vertex-frame", point, {.amount = 1.0, .seed = 7});
    EXPECT_EQ(moved.positions, (std::vector<float>{1.72559118f, 0.115104474f, 0.0203428324f}));
}

TEST(Distort, SineInSpaceIsASineOfTheFirstCoordinate)
{
    const Animation animation = wave();
    const Animation bent = after("sine-space", animation, {.amount = 0.1, .omega = 3.0});
    for (std::size_t i = 0; i < animation.positions.size(); ++i) {
        const double x = animation.positions[i / 3 * 3];
        ASSERT_NEAR(bent.positions[i], animation.positions[i] + 0.1 * std::sin(3.0 * x), 1e-6);
    }
}

TEST(Distort, SineInTimeShiftsEachFrameAsAWhole)
{
    const Animation animation = wave();
    const Animation swung = after("sine-time", animation, {.amount = 0.1, .omega = 0.7});
    for (std::size_t i = 0; i < animation.positions.size(); ++i) {
        const double f = static_cast<double>(i / (3 * animation.vertex_count));
        ASSERT_NEAR(swung.positions[i], animation.positions[i] + 0.1 * std::sin(0.7 * f), 1e-6);
    }
}

TEST(Distort, AWaveThatWouldBeInexactIsRefused)
{
    EXPECT_EQ(distort::distort(*distort::find("sine-time"), wave(), {.amount = 1, .omega = 1e6}).error().field,
              "omega");
    EXPECT_EQ(distort::distort(*distort::find("sine-space"), wave(), {.amount = 1, .omega = 1e9}).error().field,
              "omega");
}

TEST(Distort, AnAmountThatLeavesFloatIsRefused)
{
    const auto result = distort::distort(*distort::find("noise-frame"), wave(), {.amount = 1e300});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().field, "amount");
}

TEST(Distort, OneBasisIsEnoughForMotionOfRankOne)
{
    const Animation animation = *shapes::generate(*shapes::find("wave"), {.vertices = 300, .frames = 12});
    const Animation one = after("basis", animation, {.amount = 3});
    EXPECT_LT(metrics::kg_error(animation, one, Threads{1}), 0.2);
    EXPECT_FALSE(distort::distort(*distort::find("basis"), animation, {.amount = 0}).ok());
}

TEST(Distort, SmoothingMovesAVertexHalfWayToTheMeanOfItsNeighbours)
{
    Animation star = test_shapes::tetrahedron(); // everyone is everyone's neighbour: the mean is that of the others
    const Animation once = after("smooth", star, {.amount = 1});
    for (std::size_t i = 0; i < 12; ++i) {
        double others = 0;
        for (std::size_t v = 0; v < 4; ++v) others += v == i / 3 ? 0.0 : star.positions[3 * v + i % 3] / 3.0;
        EXPECT_NEAR(once.positions[i], 0.5 * star.positions[i] + 0.5 * others, 1e-6);
    }
}

TEST(Distort, TaubinsSmoothingShrinksFarLessThanLaplaces)
{
    const Animation torus = test_shapes::torus();
    const double before = total_area(torus.triangles, torus.frame(0));
    const auto area_after = [&](const char* name) {
        return total_area(torus.triangles, after(name, torus, {.amount = 10}).frame(0));
    };
    EXPECT_LT(area_after("smooth"), 0.9 * before);
    EXPECT_NEAR(area_after("taubin"), before, 0.1 * before);
}

TEST(Distort, SimplificationKeepsItsShareOfVerticesWhereTheyWereAndTheSurfaceClosed)
{
    const Animation ball = *shapes::generate(*shapes::find("jelly"), {.vertices = 1002, .frames = 3});
    const Animation part = after("simplify", ball, {.amount = 0.25});
    EXPECT_EQ(part.frame_count(), 3u);
    EXPECT_EQ(part.vertex_count, std::lround(0.25 * 1002));
    EXPECT_EQ(describe(part.vertex_count, part.triangles).boundary_edges,
              describe(ball.vertex_count, ball.triangles).boundary_edges);
    const auto is_there = [&](const float* p) {
        for (std::size_t i = 0; i < 3ul * ball.vertex_count; i += 3)
            if (std::equal(p, p + 3, &ball.positions[i])) return true;
        return false;
    };
    for (std::size_t v = 0; v < part.vertex_count; ++v) EXPECT_TRUE(is_there(&part.positions[3 * v])) << v;
}

TEST(Distort, SimplificationKeepsValuesWithTheirVertices)
{
    Animation sheet = wave();
    Attribute number;
    number.name = "number";
    number.type = Scalar::u16;
    for (std::uint32_t v = 0; v < sheet.vertex_count; ++v)
        number.values.insert(number.values.end(),
                             {static_cast<std::uint8_t>(v & 255u), static_cast<std::uint8_t>(v >> 8u)});
    sheet.appearance.attributes = {number};
    const Animation part = after("simplify", sheet, {.amount = 0.3});
    const Bytes& values = part.appearance.attributes.at(0).values;
    for (std::size_t v = 0; v < part.vertex_count; ++v) {
        const std::size_t was = values[2 * v] + 256ul * values[2 * v + 1];
        EXPECT_TRUE(std::equal(&part.positions[3 * v], &part.positions[3 * v] + 3, &sheet.positions[3 * was])) << v;
    }
}
