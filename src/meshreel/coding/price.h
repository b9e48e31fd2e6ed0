/// What decisions would cost: a coder that writes nothing and teaches nobody. Encoders only.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "meshreel/coding/range_coder.h"

namespace meshreel::coding {

/// Sums the bits that a RangeEncoder would need.
class Price {
public:
    static constexpr bool writes = true;

    bool bit(const Bit& model, bool wanted) { return decide(model.one(), wanted); }
    bool decide(std::uint32_t one, bool wanted)
    {
        bits_ -= std::log2((wanted ? one : (1u << Bit::precision) - one) * (1.0 / (1u << Bit::precision)));
        return wanted;
    }
    std::uint32_t raw(std::uint32_t value, int count)
    {
        bits_ += count;
        return value;
    }
    double bits() const { return bits_; }

private:
    double bits_ = 0.0;
};

template <>
inline constexpr bool learns<Price> = false;

} // namespace meshreel::coding
