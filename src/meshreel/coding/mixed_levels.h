/// Signed levels under several contexts at once: every decision is a mixture of what each context has learned.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "meshreel/coding/mixer.h"
#include "meshreel/coding/price.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/coding/range_coder.h"

namespace meshreel::coding {

/// Which of `columns` columns a quantity >= 0 falls into: 0 below 2^-6, then 2^fineness columns an octave, straight
/// lines between powers of two. Reads the bits of the double, so no logarithm is taken.
template <int fineness>
std::uint32_t octave_column(double quantity, std::uint32_t columns)
{
    constexpr double least = 1.0 / 64;
    if (!(quantity >= least)) return 0;
    std::uint64_t bits, base;
    std::memcpy(&bits, &quantity, sizeof bits);
    std::memcpy(&base, &least, sizeof base);
    constexpr int shift = 52 - fineness;
    const std::uint64_t column = 1 + ((bits >> shift) - (base >> shift));
    return static_cast<std::uint32_t>(column < columns ? column : columns - 1);
}

/// Levels coded as: zero or not; sign; how many bits the magnitude has, in unary; its two bits below the leading one;
/// the rest plain. All but sign and rest are mixed over `count` contexts.
template <std::size_t count>
class MixedLevels {
public:
    using Places = std::array<std::uint32_t, count>; ///< the context of each table

    /// sizes: contexts of each table. judges: sets of mixing weights to choose from.
    MixedLevels(const Places& sizes, std::uint32_t judges) : judges_(judges)
    {
        for (std::size_t i = 0; i < count; ++i) {
            nonzero_[i].resize(sizes[i]);
            beyond_[i].assign(sizes[i], nothing);
        }
    }

    /// @param judge below the number given, as every place is below its table's size.
    template <class Core>
    std::int32_t code(Core& core, const Places& places, std::uint32_t judge, std::int32_t wanted)
    {
        std::array<Bit*, count> bits;
        for (std::size_t i = 0; i < count; ++i) bits[i] = &nonzero_[i][places[i]];
        Judge& mixers = judges_[judge];
        if (!mixers.nonzero.code(core, bits, wanted != 0)) return 0;
        const bool negative = core.bit(negative_, wanted < 0);
        const std::uint32_t magnitude = code_magnitude(core, counts_of(places), mixers, size_of(wanted));
        const auto value = static_cast<std::int32_t>(magnitude < largest ? magnitude : largest);
        return negative ? -value : value;
    }

    /// The level to code for a value: the nearest, or the one below it where the bits saved are worth more than the error.
    std::int32_t choose(const Places& places, std::uint32_t judge, const Quantiser& quantiser, double value)
    {
        const std::int32_t nearest = quantiser.level(value);
        const double steps = value / quantiser.step, beyond = nearest < 0 ? nearest - steps : steps - nearest;
        if (nearest == 0 || beyond >= 0 || quantiser.bit_price == 0) return nearest;
        const std::int32_t below = nearest < 0 ? nearest + 1 : nearest - 1;
        Price much, less;
        code(much, places, judge, nearest);
        code(less, places, judge, below);
        const double more_error = (1 + beyond) * (1 + beyond) - beyond * beyond;
        return more_error < quantiser.bit_price * (much.bits() - less.bits()) ? below : nearest;
    }

private:
    static constexpr std::uint32_t largest = 0x7fffffff;
    static constexpr std::uint32_t longest = 31, told = 16; ///< bits of a magnitude; how many lengths are learned apart

    static constexpr std::uint32_t nothing = 0xffffffff;

    /// What a context has learned about magnitudes. Most contexts of a stream never meet one: made when first needed.
    struct Counts {
        std::array<Bit, told> longer;
        std::array<std::array<Bit, 3>, told> next; ///< [length] the bit below the leading one; the one after 0, after 1
    };
    struct Judge {
        Mixer<count> nonzero, next, second;
        std::array<Mixer<count>, 8> longer;
    };

    std::array<Counts*, count> counts_of(const Places& places)
    {
        for (std::size_t i = 0; i < count; ++i)
            if (beyond_[i][places[i]] == nothing) {
                beyond_[i][places[i]] = static_cast<std::uint32_t>(counts_.size());
                counts_.emplace_back();
            }
        std::array<Counts*, count> counts;
        for (std::size_t i = 0; i < count; ++i) counts[i] = &counts_[beyond_[i][places[i]]];
        return counts;
    }

    static std::uint32_t size_of(std::int32_t level)
    {
        const auto bits = static_cast<std::uint32_t>(level);
        return (level < 0 ? 0u - bits : bits) & largest;
    }
    static std::uint32_t length_of(std::uint32_t magnitude)
    {
        std::uint32_t length = 1;
        while (length < longest && magnitude >> length != 0) ++length;
        return length;
    }

    template <class Core>
    std::uint32_t code_magnitude(Core& core, const std::array<Counts*, count>& counts, Judge& mixers,
                                 std::uint32_t wanted)
    {
        std::array<Bit*, count> bits;
        const auto mixed = [&](Mixer<count>& mixer, const auto& choose, bool want) {
            for (std::size_t i = 0; i < count; ++i) bits[i] = &choose(*counts[i]);
            return mixer.code(core, bits, want);
        };
        const std::uint32_t wanted_length = length_of(wanted);
        std::uint32_t length = 1;
        while (length < longest &&
               mixed(
                   mixers.longer[length < 8 ? length - 1 : 7],
                   [&](Counts& c) -> Bit& { return c.longer[length < told ? length - 1 : told - 1]; },
                   wanted_length > length))
            ++length;
        const std::uint32_t place = length < told ? length - 1 : told - 1;
        std::uint32_t magnitude = 1, left = length - 1;
        const auto below = [&] { return left > 0 && (wanted >> (left - 1) & 1u) != 0; };
        if (left > 0) {
            const bool next = mixed(
                mixers.next, [&](Counts& c) -> Bit& { return c.next[place][0]; }, below());
            magnitude = magnitude << 1 | (next ? 1u : 0u);
            --left;
        }
        if (left > 0) {
            const std::uint32_t after = 1 + (magnitude & 1u);
            const bool second = mixed(
                mixers.second, [&](Counts& c) -> Bit& { return c.next[place][after]; }, below());
            magnitude = magnitude << 1 | (second ? 1u : 0u);
            --left;
        }
        if (left == 0) return magnitude;
        const auto count_of_bits = static_cast<int>(left);
        return magnitude << left | core.raw(wanted & ((1u << left) - 1u), count_of_bits);
    }

    std::array<std::vector<Bit>, count> nonzero_; ///< of each context: close together, most decisions are these
    std::array<std::vector<std::uint32_t>, count> beyond_; ///< place of each context in counts_
    std::vector<Counts> counts_;
    std::vector<Judge> judges_;
    Bit negative_;
};

} // namespace meshreel::coding
