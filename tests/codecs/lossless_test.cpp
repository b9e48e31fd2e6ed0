/// Every bit comes back, and where the numbers come from is found out.
// SPDX-License-Identifier: MIT
#include <bit>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/codecs/number_source.h"
#include "meshreel/mesh/shapes.h"
#include "tests/codecs/fixture.h"

using namespace meshreel;

namespace {

const codecs::Codec& exact_codec()
{
    return *codecs::find("lossless");
}

Bytes exactly(const Prepared& prepared)
{
    return exact_codec().prepare(prepared.sequence(), 1, {1})->encode({}).payload;
}

bool same_bits(const Matrix<float>& a, const Matrix<float>& b)
{
    const auto same = [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    };
    return std::ranges::equal(a.values, b.values, same);
}

Animation falling_cloth(std::uint32_t vertices = 300)
{
    return *shapes::generate(*shapes::find("cloth"), {.vertices = vertices, .frames = 12});
}

/// An animation whose numbers went through a text and then through a change of unit.
Animation from_text(Animation animation, const char* format, double scale, double offset = 0.0)
{
    for (float& x : animation.positions) {
        char text[64];
        std::snprintf(text, sizeof text, format, static_cast<double>(x));
        x = static_cast<float>(scale * static_cast<double>(std::strtof(text, nullptr)) + offset);
    }
    return animation;
}

void expect_every_bit(const Animation& animation)
{
    const Prepared prepared(animation);
    const auto back = decoded(exact_codec(), exactly(prepared), prepared);
    ASSERT_TRUE(back.ok()) << back.error().sentence();
    EXPECT_TRUE(same_bits(*back, prepared.frames));
}

} // namespace

TEST(Lossless, GivesBackEveryBitOfEveryShape)
{
    for (const shapes::Shape& shape : shapes::all())
        expect_every_bit(*shapes::generate(shape, {.vertices = 200, .frames = 10}));
}

TEST(Lossless, GivesBackAnyFloatsWhateverTheyAre)
{
    Animation animation = falling_cloth();
    Random random(5);
    for (float& x : animation.positions) {
        auto bits = static_cast<std::uint32_t>(random.bits());
        if ((bits >> 23 & 0xff) == 0xff) bits ^= 1u << 30; // neither infinite nor no number
        x = std::bit_cast<float>(bits);
    }
    expect_every_bit(animation);
}

TEST(Lossless, TellsMinusZeroFromZero)
{
    Animation animation = falling_cloth();
    for (std::size_t i = 0; i < animation.positions.size(); i += 3) animation.positions[i] = i % 2 == 0 ? 0.0f : -0.0f;
    expect_every_bit(animation);
}

TEST(Lossless, GivesBackTextsInAnyUnit)
{
    for (const char* format : {"%.4f", "%g"})
        for (const double scale : {1.0, 0.0254, -11.393806})
            expect_every_bit(from_text(falling_cloth(), format, scale));
}

TEST(NumberSource, SeesHowManyDecimalsATextHad)
{
    const Prepared prepared(from_text(falling_cloth(), "%.4f", 1.0));
    for (const coding::NumberLine& line : codecs::number_lines(prepared.frames.view(), {1})) {
        EXPECT_TRUE(line.decimal);
        EXPECT_NEAR(line.step(1.0), 1e-4, 1e-9);
    }
}

TEST(NumberSource, SeesDigitsThroughAChangeOfUnit)
{
    Animation animation = from_text(falling_cloth(3000), "%g", 1.676881507);
    const Prepared prepared(animation);
    for (const coding::NumberLine& line : codecs::number_lines(prepared.frames.view(), {1})) EXPECT_TRUE(line.decimal);
}

TEST(NumberSource, SeesIntegersThatWereScaledAndMoved)
{
    const Prepared prepared(from_text(falling_cloth(), "%.2f", 0.37, 5.5));
    for (const coding::NumberLine& line : codecs::number_lines(prepared.frames.view(), {1}))
        EXPECT_NEAR(line.step(1.0), 0.0037, 1e-6);
}

TEST(NumberSource, SeesNothingInArithmetic)
{
    const Prepared prepared(falling_cloth());
    for (const coding::NumberLine& line : codecs::number_lines(prepared.frames.view(), {1})) EXPECT_FALSE(line.decimal);
}

TEST(NumberSource, MakesTextsSmaller)
{
    const Prepared text(from_text(falling_cloth(), "%.4f", 11.3)), floats(falling_cloth());
    EXPECT_LT(exactly(text).size(), 0.7 * static_cast<double>(exactly(floats).size()));
}
