/// Several estimates of one decision mixed into a better one: a logistic mixture that learns whom to trust.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "meshreel/coding/range_coder.h"

namespace meshreel::coding {

/// Tables of LogOdds, made at compile time by + - * / alone.
struct LogOddsTables {
    static constexpr std::int32_t largest = 2047;

    std::array<std::uint16_t, 2 * largest + 1> probability{};
    std::array<std::int16_t, 4096> odds{};

#ifndef MESHREEL_DECODER_ALONE
    constexpr // where it is alone it makes them when it starts: that takes no room in its file
#endif
        LogOddsTables()
    {
        constexpr double step = 1.00391388933834757; // e^(1/256)
        double power = 1.0;
        for (std::size_t i = 0; i <= largest; ++i, power *= step) {
            const auto above = static_cast<std::uint32_t>(32768.0 * power / (1.0 + power));
            const std::uint32_t one = above > 32760 ? 32760 : above;
            probability[largest + i] = static_cast<std::uint16_t>(one);
            probability[largest - i] = static_cast<std::uint16_t>(32768 - one);
        }
        std::size_t place = 0;
        for (std::uint32_t p = 0; p < odds.size(); ++p) {
            while (place < 2 * largest && probability[place] < 8 * p + 4) ++place;
            odds[p] = static_cast<std::int16_t>(static_cast<std::int32_t>(place) - largest);
        }
    }
};

/// Log odds ln(p / (1 - p)) in 2^-8, and back.
class LogOdds {
public:
    /// @param one probability in 2^-15.
    static std::int32_t of(std::uint32_t one) { return tables.odds[one >> 3]; }
    /// Probability of a one in 2^-15, 8 .. 2^15 - 8.
    static std::uint32_t probability(std::int64_t odds)
    {
        constexpr std::int64_t largest = LogOddsTables::largest;
        return tables.probability[static_cast<std::size_t>(std::clamp(odds, -largest, largest) + largest)];
    }

private:
#ifdef MESHREEL_DECODER_ALONE
    static inline const LogOddsTables& tables = *new LogOddsTables;
#else
    static constexpr LogOddsTables tables{};
#endif
};

/// Weights of `count` estimates.
template <std::size_t count>
class Mixer {
public:
    /// Codes a decision that the given models estimate; all of them learn from it, unless it is only priced.
    template <class Coder>
    bool code(Coder& coder, const std::array<Bit*, count>& models, bool wanted)
    {
        std::array<std::int32_t, count> odds;
        std::int64_t sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            odds[i] = LogOdds::of(models[i]->one());
            sum += std::int64_t{odds[i]} * weights_[i];
        }
        const std::uint32_t one = LogOdds::probability(sum >> weight_bits);
        const bool bit = coder.decide(one, wanted);
        if constexpr (!learns<Coder>) return bit;
        const std::int32_t error = (bit ? 1 << Bit::precision : 0) - static_cast<std::int32_t>(one);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t weight = weights_[i] + ((odds[i] * error) >> rate_shift);
            weights_[i] = std::clamp(weight, -largest_weight, largest_weight);
            models[i]->learn(bit);
        }
        return bit;
    }

private:
    static constexpr int weight_bits = 16, rate_shift = 14;
    static constexpr std::int32_t largest_weight = 1 << 19;

    static constexpr std::array<std::int32_t, count> equal_weights()
    {
        std::array<std::int32_t, count> weights{};
        for (std::int32_t& weight : weights) weight = static_cast<std::int32_t>((3 << (weight_bits - 1)) / count);
        return weights;
    }
    std::array<std::int32_t, count> weights_ = equal_weights(); ///< in 2^-16, together one and a half at first
};

/// A single estimate is taken as it is.
template <>
class Mixer<1> {
public:
    template <class Coder>
    bool code(Coder& coder, const std::array<Bit*, 1>& models, bool wanted)
    {
        const bool bit = coder.decide(models[0]->one(), wanted);
        if constexpr (learns<Coder>) models[0]->learn(bit);
        return bit;
    }
};

} // namespace meshreel::coding
