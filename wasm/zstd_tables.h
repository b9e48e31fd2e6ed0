/// zstd's inner layers: bits from both ends of a stream, and the two kinds of tables that make symbols of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshreel/base/views.h"

namespace meshreel::wasm {

inline std::uint64_t little(const std::uint8_t* bytes, std::size_t count)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t{bytes[i]} << (8 * i);
    return value;
}

/// Position of the highest set bit; value > 0.
inline std::uint32_t log2_of(std::uint32_t value)
{
    return 31u - static_cast<std::uint32_t>(__builtin_clz(value));
}

/// Bytes taken from the front. After a take that there is not enough for, everything is empty and `failed`.
struct Front {
    ByteView left;
    bool failed = false;

    ByteView take(std::uint64_t count)
    {
        if (count > left.size()) {
            failed = true;
            left = {};
            return {};
        }
        const ByteView taken = left.first(static_cast<std::size_t>(count));
        left = left.subspan(static_cast<std::size_t>(count));
        return taken;
    }
    std::uint64_t number(std::size_t bytes)
    {
        const ByteView taken = take(bytes);
        return little(taken.data(), taken.size());
    }
};

/// Bits read from the end of a stream to its beginning; before that all are 0 and `at` is below 0.
struct BackBits {
    ByteView bytes;
    std::int64_t at = 0; ///< bits left

    /// The highest set bit of the last byte marks the end.
    static std::optional<BackBits> open(ByteView bytes)
    {
        if (bytes.empty() || bytes.back() == 0) return {};
        return BackBits{bytes, static_cast<std::int64_t>(8 * (bytes.size() - 1) + log2_of(bytes.back()))};
    }

    /// count <= 32
    std::uint32_t read(std::uint32_t count)
    {
        at -= count;
        at = std::max<std::int64_t>(at, -63); // far beyond the beginning: wrong however far
        const std::int64_t begin = std::max<std::int64_t>(at, 0);
        const auto first = static_cast<std::size_t>(begin >> 3);
        if (count == 0 || first >= bytes.size()) return 0;
        std::uint64_t value = little(bytes.data() + first, std::min<std::size_t>(5, bytes.size() - first));
        value = at >= 0 ? value >> (begin & 7) : value << -at;
        return static_cast<std::uint32_t>(value & ((std::uint64_t{1} << count) - 1));
    }
};

/// A table of finite state entropy: what a state stands for, and how the next one follows.
struct Fse {
    struct Cell {
        std::uint8_t symbol, bits;
        std::uint16_t base;
    };
    std::uint32_t log = 0;
    std::vector<Cell> cells; ///< [2^log]; empty: there is no table yet

    std::uint32_t start(BackBits& bits) const { return bits.read(log); }
    std::uint32_t next(std::uint32_t state, BackBits& bits) const
    {
        return cells[state].base + bits.read(cells[state].bits);
    }
};

inline Fse one_symbol(std::uint8_t symbol)
{
    return {0, {{symbol, 0, 0}}};
}

/// Probabilities add up to 2^log; -1: below one.
inline Fse fse_of(std::uint32_t log, std::span<const std::int16_t> shares)
{
    const std::uint32_t size = 1u << log, step = (size >> 1) + (size >> 3) + 3;
    Fse table{log, std::vector<Fse::Cell>(size)};
    std::array<std::uint16_t, 256> next{};
    std::uint32_t high = size, place = 0;
    for (std::size_t s = 0; s < shares.size(); ++s)
        if (shares[s] < 0) table.cells[--high].symbol = static_cast<std::uint8_t>(s);
    for (std::size_t s = 0; s < shares.size(); ++s) {
        next[s] = static_cast<std::uint16_t>(shares[s] < 0 ? 1 : shares[s]);
        for (int i = 0; i < shares[s]; ++i) {
            table.cells[place].symbol = static_cast<std::uint8_t>(s);
            do place = (place + step) & (size - 1);
            while (place >= high);
        }
    }
    for (Fse::Cell& cell : table.cells) {
        const std::uint32_t state = next[cell.symbol]++;
        cell.bits = static_cast<std::uint8_t>(log - log2_of(state));
        cell.base = static_cast<std::uint16_t>((state << cell.bits) - size);
    }
    return table;
}

/// Bits from the front of a stream, for the descriptions of FSE tables.
struct ForwardBits {
    ByteView bytes;
    std::size_t at = 0;

    std::uint32_t read(std::uint32_t count)
    {
        const std::size_t first = at >> 3;
        const std::uint64_t value =
            first < bytes.size() ? little(bytes.data() + first, std::min<std::size_t>(4, bytes.size() - first)) : 0;
        const auto shifted = static_cast<std::uint32_t>(value >> (at & 7));
        at += count;
        return shifted & ((1u << count) - 1);
    }
};

/// One probability, up to `left`; its length depends on what is left.
inline int read_share(ForwardBits& bits, std::uint32_t left)
{
    const std::uint32_t length = log2_of(left + 1) + 1, low_mask = (1u << (length - 1)) - 1,
                        threshold = (1u << length) - 2 - left;
    std::uint32_t value = bits.read(length);
    if ((value & low_mask) < threshold) {
        --bits.at;
        value &= low_mask;
    } else if (value > low_mask) {
        value -= threshold;
    }
    return static_cast<int>(value) - 1;
}

/// What a table of FSE may be.
struct FseBounds {
    std::uint32_t largest_log = 0, symbols = 0;
};

/// A table from its description. Empty: there is none.
inline Fse read_fse(Front& front, FseBounds bounds)
{
    ForwardBits bits{front.left};
    const std::uint32_t log = 5 + bits.read(4);
    if (log > bounds.largest_log) return {};
    std::vector<std::int16_t> shares;
    for (std::uint32_t left = 1u << log; left > 0;) {
        if (shares.size() >= bounds.symbols || bits.at > 8 * front.left.size()) return {};
        const int share = read_share(bits, left);
        left -= static_cast<std::uint32_t>(share < 0 ? 1 : share);
        shares.push_back(static_cast<std::int16_t>(share));
        for (std::uint32_t zeros = 3; share == 0 && zeros == 3 && shares.size() <= bounds.symbols;) {
            zeros = bits.read(2);
            shares.insert(shares.end(), zeros, 0);
        }
    }
    front.take((bits.at + 7) / 8);
    if (front.failed || shares.size() > bounds.symbols) return {};
    return fse_of(log, shares);
}

/// Which literal a few bits stand for, and how many of them it takes.
struct Huffman {
    struct Cell {
        std::uint8_t symbol, bits;
    };
    std::uint32_t log = 0;   ///< 1 .. 11
    std::vector<Cell> cells; ///< [2^log]; empty: there is no table yet
};

inline constexpr std::uint32_t longest_code = 11;

/// Two states take turns until the bits are used up. Empty: wrong.
inline std::vector<std::uint8_t> fse_weights(ByteView bytes)
{
    Front front{bytes};
    const Fse table = read_fse(front, {6, longest_code + 2});
    auto bits = BackBits::open(front.left);
    if (table.cells.empty() || !bits) return {};
    std::array<std::uint32_t, 2> states{};
    for (std::uint32_t& state : states) state = table.start(*bits);
    std::vector<std::uint8_t> weights;
    for (std::size_t turn = 0; bits->at >= 0; turn ^= 1) {
        weights.push_back(table.cells[states[turn]].symbol);
        states[turn] = table.next(states[turn], *bits);
        if (bits->at < 0) weights.push_back(table.cells[states[turn ^ 1]].symbol);
        if (weights.size() > 255) return {};
    }
    return weights;
}

/// Weights of all symbols but the last. Empty: wrong.
inline std::vector<std::uint8_t> read_weights(Front& front)
{
    const auto head = static_cast<std::uint32_t>(front.number(1));
    if (head < 128) return fse_weights(front.take(head));
    const std::uint32_t count = head - 127;
    const ByteView packed = front.take((count + 1) / 2);
    std::vector<std::uint8_t> weights(front.failed ? 0 : count);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = i % 2 == 0 ? packed[i / 2] >> 4 : packed[i / 2] & 15;
    return weights;
}

/// The last weight is what makes the sum a power of two. Empty: wrong.
inline Huffman read_huffman(Front& front)
{
    std::vector<std::uint8_t> weights = read_weights(front);
    std::uint32_t sum = 0;
    for (const std::uint8_t w : weights) {
        if (w > longest_code) return {};
        sum += w > 0 ? 1u << (w - 1) : 0;
    }
    if (sum == 0) return {};
    const std::uint32_t log = log2_of(sum) + 1, rest = (1u << log) - sum;
    if (log > longest_code || (rest & (rest - 1)) != 0) return {};
    weights.push_back(static_cast<std::uint8_t>(log2_of(rest) + 1));
    Huffman table{log, {}};
    for (std::uint32_t weight = 1; weight <= log; ++weight)
        for (std::size_t s = 0; s < weights.size(); ++s)
            if (weights[s] == weight)
                table.cells.insert(table.cells.end(), std::size_t{1} << (weight - 1),
                                   {static_cast<std::uint8_t>(s), static_cast<std::uint8_t>(log + 1 - weight)});
    return table;
}

} // namespace meshreel::wasm
