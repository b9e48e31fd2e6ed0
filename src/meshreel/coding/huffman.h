/// Canonical Huffman codes with transmitted tables: the thesis' entropy coder (2.2) as a SymbolCoder.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/coding/bits.h"
#include "meshreel/coding/range_symbols.h"

namespace meshreel::coding {

constexpr int longest_code = 32;

/// Code lengths of an optimal prefix code, none longer than longest_code: the counts are halved until that holds.
/// @param counts  [n] occurrences.  @return [n] lengths, 0 where the count is 0; a lone symbol has length 0 too.
/// @cost O(n log n).
std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint64_t> counts);

/// A canonical code: shorter codes first, equal lengths in the symbols' order.
class HuffmanCode {
public:
    /// @fails bad_input: the lengths are over-subscribed or leave codes unused. A table of no or one symbol is written
    /// by its own constructors.
    static Result<HuffmanCode> from_lengths(std::span<const std::uint8_t> lengths);
    /// The code of a single symbol, which takes no bits.
    static HuffmanCode lone(std::uint32_t symbol);
    HuffmanCode() = default; ///< no symbol at all; get() returns 0

    void put(BitWriter& bits, std::uint32_t symbol) const { bits.put(words_[symbol], lengths_[symbol]); }
    std::uint32_t get(BitReader& bits) const;

private:
    std::array<std::uint64_t, longest_code + 1> end_{};  ///< first code of each length that is not of this length
    std::array<std::uint32_t, longest_code + 1> skip_{}; ///< place in sorted_ minus code, modulo 2^32
    std::vector<std::uint32_t> sorted_;                  ///< symbols by code
    std::vector<std::uint32_t> words_;                   ///< [n] writer's side: code words
    std::vector<std::uint8_t> lengths_;                  ///< [n]
};

/// Collects everything, then writes one table a context and the codes.
class HuffmanWriter {
public:
    static constexpr bool writes = true;

    explicit HuffmanWriter(const Contexts& contexts);

    std::int32_t level(std::uint32_t context, std::int32_t wanted);
    std::int32_t symbol(std::uint32_t context, std::int32_t wanted);
    std::int32_t bits(std::int32_t value, int count);
    /// Tables and codes; the writer is spent.
    Bytes finish();

private:
    struct Item {
        std::uint32_t table; ///< or raw
        std::uint32_t symbol;
        std::uint32_t rest;
        std::uint8_t rest_bits;
    };
    static constexpr std::uint32_t raw = 0xffffffff;

    std::uint32_t level_contexts_;
    std::vector<std::vector<std::uint64_t>> counts_; ///< [table] occurrences of each symbol met so far
    std::vector<Item> items_;
};

/// Reads what a HuffmanWriter with the same contexts wrote.
class HuffmanReader {
public:
    static constexpr bool writes = false;

    /// @fails bad_input: absurd contexts, tables that are cut, over-subscribed or incomplete.
    static Result<HuffmanReader> open(ByteView bytes, const Contexts& contexts);

    std::int32_t level(std::uint32_t context, std::int32_t = 0);
    std::int32_t symbol(std::uint32_t context, std::int32_t = 0);
    std::int32_t bits(std::int32_t, int count) { return static_cast<std::int32_t>(bits_.get(count)); }
    bool overrun() const { return bits_.overrun(); }

private:
    HuffmanReader(std::uint32_t level_contexts, std::vector<HuffmanCode> codes, ByteView body)
        : level_contexts_(level_contexts), codes_(std::move(codes)), bits_(body)
    {
    }

    std::uint32_t level_contexts_;
    std::vector<HuffmanCode> codes_;
    BitReader bits_;
};

static_assert(SymbolCoder<HuffmanWriter> && SymbolCoder<HuffmanReader>);

} // namespace meshreel::coding
