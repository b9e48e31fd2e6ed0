/// The parallelogram rule on vectors of any length.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace meshreel::predict {

/// guess = left + right - opposite, component by component; all of length K.  @source thesis (8.1)
inline void parallelogram(std::span<const double> left, std::span<const double> right, std::span<const double> opposite,
                          std::span<double> guess)
{
    for (std::size_t i = 0; i < guess.size(); ++i) guess[i] = left[i] + right[i] - opposite[i]; // (8.1)
}

} // namespace meshreel::predict
