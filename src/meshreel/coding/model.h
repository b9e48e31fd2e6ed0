/// Integers out of adaptive binary decisions: small alphabets as trees, numbers of any size by their magnitude.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "meshreel/coding/range_coder.h"

namespace meshreel::coding {

/// The number of bits of x, 0 for 0.
constexpr int bit_width(std::uint64_t x)
{
    int width = 0;
    for (; x != 0; x >>= 1) ++width;
    return width;
}

/// A symbol 0 .. alphabet-1 as a walk down a binary tree, each node a decision of its own. A decoder never returns a
/// symbol outside the alphabet.
class TreeModel {
public:
    explicit TreeModel(std::uint32_t alphabet = 2)
        : alphabet_(alphabet), depth_(bit_width(alphabet == 0 ? 0 : alphabet - 1)), nodes_(std::size_t{1} << depth_)
    {
    }

    template <class Coder>
    std::uint32_t code(Coder& coder, std::uint32_t wanted)
    {
        std::uint32_t node = 1;
        for (int left = depth_ - 1; left >= 0; --left) {
            const std::uint64_t least_right = ((std::uint64_t{node} << 1 | 1u) << left) - (std::uint64_t{1} << depth_);
            const bool right = least_right < alphabet_ && coder.bit(nodes_[node], wanted >> left & 1u);
            node = node << 1 | (right ? 1u : 0u);
        }
        return node - (1u << depth_);
    }

private:
    std::uint32_t alphabet_;
    int depth_;
    std::vector<Bit> nodes_;
};

/// A number from 0 by its bit width (adaptive), the three bits below the top one (adaptive) and the rest (raw): an
/// Exp-Golomb code that learns.
class NumberModel {
public:
    template <class Coder>
    std::uint64_t code(Coder& coder, std::uint64_t wanted)
    {
        const std::uint64_t shifted = wanted + 1; // its top bit is always one
        const int wanted_exponent = bit_width(shifted) - 1;
        int exponent = 0;
        while (exponent < largest_exponent && coder.bit(exponent_[exponent], exponent < wanted_exponent)) ++exponent;
        std::uint64_t value = 1;
        int left = exponent;
        for (int node = 1; left > 0 && node < 8; --left) {
            const bool bit = coder.bit(mantissa_[exponent][node], shifted >> (left - 1) & 1u);
            value = value << 1 | (bit ? 1u : 0u);
            node = node << 1 | (bit ? 1 : 0);
        }
        const std::uint64_t low =
            left > 0 ? coder.raw(static_cast<std::uint32_t>(shifted & ((1ull << left) - 1)), left) : 0;
        return (value << left | low) - 1;
    }

    static constexpr int largest_exponent = 32; ///< numbers below 2^33 - 1

private:
    std::array<Bit, largest_exponent> exponent_;
    std::array<std::array<Bit, 8>, largest_exponent + 1> mantissa_;
};

/// A signed level: zero or not, sign, then the magnitude in unary up to 14 and by a NumberModel beyond.
class LevelModel {
public:
    template <class Coder>
    std::int32_t code(Coder& coder, std::int32_t wanted)
    {
        if (!coder.bit(nonzero_, wanted != 0)) return 0;
        const bool negative = coder.bit(negative_, wanted < 0);
        const std::int64_t wanted_magnitude = wanted < 0 ? -std::int64_t{wanted} : std::int64_t{wanted};
        std::int64_t magnitude = 1;
        while (magnitude <= unary && coder.bit(more_[magnitude - 1], wanted_magnitude > magnitude)) ++magnitude;
        if (magnitude > unary) {
            if (!escape_) escape_ = std::make_unique<NumberModel>();
            const std::uint64_t beyond = Coder::writes ? static_cast<std::uint64_t>(wanted_magnitude - magnitude) : 0;
            magnitude += static_cast<std::int64_t>(escape_->code(coder, beyond));
        }
        const std::int64_t most = negative ? std::int64_t{1} << 31 : (std::int64_t{1} << 31) - 1;
        const std::int64_t value = magnitude < most ? magnitude : most;
        return static_cast<std::int32_t>(negative ? -value : value);
    }

private:
    static constexpr int unary = 14;

    Bit nonzero_;
    Bit negative_;
    std::array<Bit, unary> more_;
    std::unique_ptr<NumberModel> escape_; ///< made when first needed: most contexts never do
};

} // namespace meshreel::coding
