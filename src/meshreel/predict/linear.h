/// Linear prediction (LPC): the next value of a series from weights of those before it (Karni and Gotsman).
// SPDX-License-Identifier: MIT
#pragma once

namespace meshreel::predict {

constexpr int linear_orders = 4; ///< at most so many values before

/// a_0 + sum a_j v[-j], j = 1 .. order; v points one past the latest known value, weights [order + 1].
/// @source thesis (3.21)
inline double linear(const double* v, int order, const double* weights)
{
    double guess = weights[0];
    for (int j = 1; j <= order; ++j) guess += weights[j] * v[-j]; // (3.21)
    return guess;
}

} // namespace meshreel::predict
