/// Bits, varints, quantiser, trees, Huffman tables, each by itself.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "meshreel/coding/bits.h"
#include "meshreel/coding/huffman.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/coding/varint.h"
#include "tests/coding/sources.h"

namespace meshreel::coding {
namespace {

using testing::ElementsAre;
using Lengths = std::vector<std::uint8_t>;

TEST(bits, come_back_in_order_highest_first)
{
    BitWriter writer;
    writer.put(0b101, 3);
    writer.put(0xffffffff, 32);
    writer.put(0, 0);
    EXPECT_THAT(writer.bytes(), ElementsAre(0b10111111, 0xff, 0xff, 0xff, 0b11100000));
    BitReader reader(writer.bytes());
    EXPECT_EQ(reader.get(3), 0b101u);
    EXPECT_EQ(reader.get(32), 0xffffffffu);
    EXPECT_FALSE(reader.overrun());
}

TEST(bits, past_the_end_are_zero_and_overrun_stays)
{
    const Bytes one = {0xff};
    BitReader reader(one);
    EXPECT_EQ(reader.get(9), 0x1feu);
    EXPECT_TRUE(reader.overrun());
}

TEST(varint, gives_back_numbers_of_any_size)
{
    for (const std::uint64_t number : {0ull, 1ull, 127ull, 128ull, 300ull, 1ull << 35, ~0ull}) {
        Bytes bytes;
        put_varint(bytes, number);
        VarintReader reader(bytes);
        EXPECT_EQ(*reader.number("n"), number);
        EXPECT_EQ(reader.offset(), bytes.size());
    }
}

TEST(varint, names_the_byte_and_the_field_where_it_ends_too_early_or_is_too_long)
{
    const Bytes cut = {1, 0x80};
    VarintReader reader(cut);
    ASSERT_TRUE(reader.number("first"));
    EXPECT_EQ(reader.number("second").error().sentence(), "byte 1: second: the bytes end here");
    const Bytes huge(11, 0xff);
    EXPECT_FALSE(VarintReader(huge).number("n"));
}

TEST(zigzag, folds_and_unfolds_both_ends)
{
    EXPECT_EQ(zigzag(-1), 1u);
    EXPECT_EQ(zigzag(1), 2u);
    for (const std::int64_t value : {INT64_MIN, INT64_MAX, std::int64_t{0}, std::int64_t{-77}})
        EXPECT_EQ(unzigzag(zigzag(value)), value);
}

TEST(quantiser, rounds_halves_away_from_zero_and_saturates)
{
    const Quantiser half{0.5};
    EXPECT_EQ(half.level(0.25), 1);
    EXPECT_EQ(half.level(-0.25), -1);
    EXPECT_EQ(half.level(0.2499), 0);
    EXPECT_EQ(half.level(1e300), Quantiser::largest_level);
    EXPECT_EQ(half.level(-std::numeric_limits<double>::infinity()), -Quantiser::largest_level);
    EXPECT_EQ(half.level(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(half.value(-3), -1.5);
}

TEST(range_coder, carries_through_a_run_of_full_bytes)
{
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        RangeEncoder encoder;
        std::vector<std::uint32_t> values;
        for (int i = 0; i < 12; ++i)
            values.push_back(random.below(4) == 0 ? 0 : static_cast<std::uint32_t>(random.bits()) | 0xffff0000u);
        for (const std::uint32_t value : values) encoder.raw(value, 32);
        const Bytes bytes = encoder.finish();
        RangeDecoder decoder(bytes);
        for (const std::uint32_t value : values) ASSERT_EQ(decoder.raw(0, 32), value);
    }
}

TEST(range_coder, writes_nothing_in_no_bytes_and_certain_decisions_in_very_few)
{
    EXPECT_TRUE(RangeEncoder{}.finish().empty());
    RangeEncoder encoder;
    Bit model;
    for (int i = 0; i < 10'000; ++i) encoder.bit(model, false);
    EXPECT_LE(encoder.finish().size(), 6u);
}

TEST(huffman_lengths, are_the_textbook_ones)
{
    EXPECT_THAT(huffman_lengths(std::vector<std::uint64_t>{45, 13, 12, 16, 9, 5}), ElementsAre(1, 3, 3, 3, 4, 4));
    EXPECT_THAT(huffman_lengths(std::vector<std::uint64_t>{1, 1, 1, 1}), ElementsAre(2, 2, 2, 2));
    EXPECT_THAT(huffman_lengths(std::vector<std::uint64_t>{0, 7, 0, 3}), ElementsAre(0, 1, 0, 1));
}

TEST(huffman_lengths, handle_no_symbol_and_one_symbol)
{
    EXPECT_TRUE(huffman_lengths({}).empty());
    EXPECT_THAT(huffman_lengths(std::vector<std::uint64_t>{0, 9}), ElementsAre(0, 0));
}

TEST(huffman_lengths, never_exceed_the_longest_code)
{
    std::vector<std::uint64_t> fibonacci = {1, 1};
    while (fibonacci.size() < 70) fibonacci.push_back(fibonacci.back() + fibonacci[fibonacci.size() - 2]);
    const Lengths lengths = huffman_lengths(fibonacci);
    EXPECT_EQ(*std::max_element(lengths.begin(), lengths.end()), longest_code);
    EXPECT_TRUE(HuffmanCode::from_lengths(lengths));
}

TEST(huffman_code, refuses_over_subscribed_and_incomplete_lengths)
{
    EXPECT_FALSE(HuffmanCode::from_lengths(Lengths{1, 1, 1}));
    EXPECT_FALSE(HuffmanCode::from_lengths(Lengths{1, 2}));
    EXPECT_FALSE(HuffmanCode::from_lengths(Lengths{0, 0}));
    EXPECT_FALSE(HuffmanCode::from_lengths(Lengths(200, 2)));
    EXPECT_TRUE(HuffmanCode::from_lengths(Lengths{2, 1, 2}));
}

} // namespace
} // namespace meshreel::coding
