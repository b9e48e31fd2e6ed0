/// What an effort of 1 to 9 means: where a search begins, and what it varies.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/tune/search.h"

namespace meshreel {

/// What is to look or measure best.
enum class Tune : std::uint8_t {
    kg,  ///< all positions: the KG error
    sted ///< what people see: STED, local distortion
};

namespace tune {

inline constexpr int least_effort = 1, usual_effort = 5, most_effort = 9;

struct Plan {
    codecs::Settings start; ///< all but the step
    std::vector<Knob> knobs;
    int rounds = 1;
    double telling = 0.1; ///< as in Problem
};

/// @pre effort in [least_effort, most_effort]
Plan plan_of(int effort, Tune tune);

} // namespace tune
} // namespace meshreel
