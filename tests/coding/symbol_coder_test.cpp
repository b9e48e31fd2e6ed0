/// What every SymbolCoder promises: the same symbols back, close to the entropy, no crash on cut or foreign bytes.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/coding/huffman.h"
#include "meshreel/coding/range_symbols.h"
#include "tests/coding/sources.h"

namespace meshreel::coding {
namespace {

struct Range {
    using Writer = RangeWriter;
    using Reader = RangeReader;
};
struct Huffman {
    using Writer = HuffmanWriter;
    using Reader = HuffmanReader;
};

template <class Pair>
class EverySymbolCoder : public testing::Test {
};
using Pairs = testing::Types<Range, Huffman>;
TYPED_TEST_SUITE(EverySymbolCoder, Pairs);

template <class Pair>
Bytes written(const Contexts& contexts, const std::vector<std::int32_t>& levels)
{
    typename Pair::Writer writer(contexts);
    for (std::size_t i = 0; i < levels.size(); ++i)
        writer.level(static_cast<std::uint32_t>(i % contexts.levels), levels[i]);
    return writer.finish();
}

TYPED_TEST(EverySymbolCoder, gives_back_levels_of_any_size)
{
    for (const auto& levels :
         {extreme_levels(), laplacian(1, 3000, 0.3), laplacian(2, 3000, 40), laplacian(3, 300, 1e6)}) {
        const Contexts contexts{7, {}};
        const Bytes bytes = written<TypeParam>(contexts, levels);
        auto reader = TypeParam::Reader::open(bytes, contexts);
        ASSERT_TRUE(reader);
        for (std::size_t i = 0; i < levels.size(); ++i)
            ASSERT_EQ(reader->level(static_cast<std::uint32_t>(i % 7), 0), levels[i]);
        EXPECT_FALSE(reader->overrun());
    }
}

TYPED_TEST(EverySymbolCoder, mixes_levels_symbols_and_raw_bits)
{
    const Contexts contexts{2, {1, 2, 5, 300, 65536}};
    typename TypeParam::Writer writer(contexts);
    const auto walk = [&](auto& coder) {
        Random random(5);
        bool same = true;
        for (int i = 0; i < 2000; ++i) {
            const auto context = static_cast<std::uint32_t>(random.below(5));
            const auto symbol = static_cast<std::int32_t>(random.below(contexts.alphabets[context]));
            const auto value = static_cast<std::int32_t>(random.below(1u << 31));
            same = same && coder.symbol(context, symbol) == symbol && coder.bits(value, 31) == value;
            same = same && coder.level(context & 1u, symbol - 7) == symbol - 7;
        }
        return same;
    };
    walk(writer);
    const Bytes bytes = writer.finish();
    auto reader = TypeParam::Reader::open(bytes, contexts);
    ASSERT_TRUE(reader);
    EXPECT_TRUE(walk(*reader));
    EXPECT_FALSE(reader->overrun());
}

TYPED_TEST(EverySymbolCoder, says_overrun_when_much_is_cut_and_never_crashes)
{
    const Contexts contexts{3, {}};
    const std::vector<std::int32_t> levels = laplacian(4, 400, 9);
    const Bytes bytes = written<TypeParam>(contexts, levels);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        auto reader = TypeParam::Reader::open(ByteView(bytes).first(size), contexts);
        if (!reader) continue;
        for (std::size_t i = 0; i < levels.size(); ++i) reader->level(static_cast<std::uint32_t>(i % 3), 0);
        EXPECT_TRUE(reader->overrun() || size + 4 > bytes.size()) << size;
    }
}

TYPED_TEST(EverySymbolCoder, reads_any_bytes_without_harm)
{
    Random random(6);
    const Contexts contexts{3, {17}};
    for (int trial = 0; trial < 300; ++trial) {
        Bytes bytes(random.below(200));
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
        auto reader = TypeParam::Reader::open(bytes, contexts);
        if (!reader) continue;
        for (std::uint32_t i = 0; i < 500; ++i) {
            reader->level(i % 3, 0);
            ASSERT_LT(static_cast<std::uint32_t>(reader->symbol(0, 0)), 17u);
            reader->bits(0, static_cast<int>(i % 32));
        }
    }
}

TYPED_TEST(EverySymbolCoder, pays_almost_nothing_for_contexts_that_are_never_used)
{
    typename TypeParam::Writer writer({1000, {}});
    writer.level(500, 3);
    EXPECT_LE(writer.finish().size(), 12u);
}

TYPED_TEST(EverySymbolCoder, refuses_absurd_contexts)
{
    EXPECT_FALSE(TypeParam::Reader::open({}, {Contexts::most + 1, {}}));
    EXPECT_FALSE(TypeParam::Reader::open({}, {1, {1u << 20}}));
}

TEST(range_writer, comes_within_one_percent_of_the_entropy)
{
    for (const double scale : {0.1, 0.5, 2.0, 8.0, 40.0}) {
        const std::vector<std::int32_t> levels = laplacian(8, 100'000, scale);
        const double bits = 8.0 * static_cast<double>(written<Range>({1, {}}, levels).size());
        EXPECT_LT(bits, 1.01 * entropy_bits(levels) + 300) << scale;
    }
}

TEST(huffman_writer, stays_within_one_bit_a_symbol_of_the_entropy)
{
    for (const double scale : {0.1, 0.5, 2.0, 8.0, 40.0}) {
        const std::vector<std::int32_t> levels = laplacian(8, 100'000, scale);
        const double bits = 8.0 * static_cast<double>(written<Huffman>({1, {}}, levels).size());
        EXPECT_LT(bits, entropy_bits(levels) + 100'000) << scale;
    }
}

} // namespace
} // namespace meshreel::coding
