/// Made data for the tests of the coders.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "meshreel/base/random.h"

namespace meshreel::coding {

/// Levels whose magnitudes fall off geometrically; now and then one of any size.
inline std::vector<std::int32_t> laplacian(std::uint64_t seed, std::size_t count, double scale)
{
    Random random(seed);
    std::vector<std::int32_t> levels(count);
    for (std::int32_t& level : levels) {
        const double magnitude = -std::log(1.0 - random.uniform()) * scale;
        level = static_cast<std::int32_t>(std::lround(random.uniform() < 0.5 ? -magnitude : magnitude));
    }
    return levels;
}

/// Levels at the ends of every octave, and the two ends of the type.
inline std::vector<std::int32_t> extreme_levels()
{
    std::vector<std::int32_t> levels = {INT32_MIN, INT32_MAX, INT32_MIN + 1, 0};
    for (int bit = 0; bit < 31; ++bit)
        for (const int nudge : {-1, 0, 1})
            for (const int sign : {-1, 1}) levels.push_back(sign * ((1 << (bit < 30 ? bit : 30)) + nudge));
    return levels;
}

/// n H of the values' relative frequencies, bits. @source thesis (2.6)
inline double entropy_bits(const std::vector<std::int32_t>& values)
{
    std::map<std::int32_t, double> counts;
    for (const std::int32_t value : values) ++counts[value];
    double bits = 0;
    for (const auto& [value, count] : counts) bits -= count * std::log2(count / static_cast<double>(values.size()));
    return bits;
}

} // namespace meshreel::coding
