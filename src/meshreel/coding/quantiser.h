/// Uniform quantisation: a real number becomes a whole number of steps.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshreel/base/exact.h"

namespace meshreel::coding {

/// v = k C_q + e, the residual e within half a step either way unless k saturates. @source thesis (2.5)
struct Quantiser {
    double step = 1.0;      ///< C_q, units of the values, > 0
    double bit_price = 0.0; ///< squared steps that saving a bit is worth, >= 0; 0 rounds to the nearest. Encoders only

    static constexpr std::int32_t largest_level = 1 << 30; ///< beyond it levels saturate

    /// The nearest level, halves away from zero; what is no number becomes 0.
    std::int32_t level(double value) const
    {
        const double steps = value / step;
        if (steps >= largest_level) return largest_level;
        if (steps <= -largest_level) return -largest_level;
        return steps == steps ? static_cast<std::int32_t>(exact::round(steps)) : 0;
    }
    double value(std::int32_t level) const { return level * step; }
};

} // namespace meshreel::coding
