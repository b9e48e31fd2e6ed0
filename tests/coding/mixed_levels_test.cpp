/// Levels under several contexts: what comes out is what went in, whatever the contexts.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "meshreel/coding/mixed_levels.h"

using namespace meshreel;
using namespace meshreel::coding;

namespace {

constexpr std::int32_t extreme = 0x7fffffff;

/// Levels of every size, with a context that knows nothing and one that knows the size.
std::vector<std::int32_t> levels_of_every_size()
{
    std::mt19937 random(5);
    std::vector<std::int32_t> levels{0, 1, -1, extreme, -extreme, 1 << 30};
    for (int i = 0; i < 4000; ++i) {
        const auto size = static_cast<std::int32_t>(random() >> (1 + random() % 31));
        levels.push_back(random() % 2 != 0 ? -size : size);
    }
    return levels;
}

} // namespace

TEST(MixedLevels, ComeBackAsTheyWere)
{
    const std::vector<std::int32_t> levels = levels_of_every_size();
    RangeEncoder encoder;
    MixedLevels<2> writer({1, 4}, 2);
    for (std::uint32_t i = 0; i < levels.size(); ++i) writer.code(encoder, {0, i % 4}, i % 2, levels[i]);
    const Bytes bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    MixedLevels<2> reader({1, 4}, 2);
    for (std::uint32_t i = 0; i < levels.size(); ++i) ASSERT_EQ(reader.code(decoder, {0, i % 4}, i % 2, 0), levels[i]);
    EXPECT_FALSE(decoder.overrun());
}

TEST(MixedLevels, CostLessWhereAContextTellsTheirSize)
{
    const auto cost = [](bool told) {
        std::mt19937 random(5);
        RangeEncoder encoder;
        MixedLevels<2> writer({1, 2}, 1);
        for (int i = 0; i < 4000; ++i) {
            const std::uint32_t large = random() % 2;
            const auto level = static_cast<std::int32_t>(random() % (large != 0 ? 40 : 2));
            writer.code(encoder, {0, told ? large : 0}, 0, level);
        }
        return encoder.finish().size();
    };
    EXPECT_LT(static_cast<double>(cost(true)), 0.9 * static_cast<double>(cost(false)));
}

TEST(MixedLevels, ChooseTheLevelNextToTheNearestWhereItSavesEnough)
{
    RangeEncoder encoder;
    MixedLevels<1> levels({1}, 1);
    for (int i = 0; i < 500; ++i) levels.code(encoder, {0}, 0, 0);
    EXPECT_EQ(levels.choose({0}, 0, {2.0, 0.0}, 1.2), 1);
    EXPECT_EQ(levels.choose({0}, 0, {2.0, 0.1}, 1.2), 0);
    EXPECT_EQ(levels.choose({0}, 0, {2.0, 0.1}, -1.2), 0);
    EXPECT_EQ(levels.choose({0}, 0, {2.0, 0.1}, 2.2), 1);
}

TEST(MixedLevels, CostTheirPriceAndLearnNothingFromIt)
{
    const std::vector<std::int32_t> levels = levels_of_every_size();
    RangeEncoder encoder;
    MixedLevels<2> writer({1, 4}, 2);
    double bits = 0;
    for (std::uint32_t i = 0; i < levels.size(); ++i) {
        Price price, again;
        writer.code(price, {0, i % 4}, i % 2, levels[i]);
        writer.code(again, {0, i % 4}, i % 2, levels[i]);
        EXPECT_EQ(price.bits(), again.bits());
        bits += price.bits();
        writer.code(encoder, {0, i % 4}, i % 2, levels[i]);
    }
    const auto written = 8 * static_cast<double>(encoder.finish().size());
    EXPECT_NEAR(bits, written, 0.001 * written);
}

TEST(MixedLevels, ReadAnyBytes)
{
    std::mt19937 random(9);
    Bytes bytes(3000);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    RangeDecoder decoder(bytes);
    MixedLevels<1> reader({1}, 1);
    std::size_t read = 0;
    while (!decoder.overrun() && read < 1'000'000) {
        reader.code(decoder, {0}, 0, 0);
        ++read;
    }
    EXPECT_TRUE(decoder.overrun());
}

TEST(OctaveColumn, RisesWithTheQuantityAndStaysBelowTheCount)
{
    std::uint32_t last = octave_column<1>(0.0, 20);
    EXPECT_EQ(last, 0u);
    for (double quantity = 0.001; quantity < 1e6; quantity *= 1.1) {
        const std::uint32_t column = octave_column<1>(quantity, 20);
        EXPECT_GE(column, last);
        EXPECT_LT(column, 20u);
        last = column;
    }
    EXPECT_EQ(octave_column<0>(2.0, 99), octave_column<0>(1.0, 99) + 1);
    EXPECT_EQ(octave_column<2>(2.0, 99), octave_column<2>(1.0, 99) + 4);
}
