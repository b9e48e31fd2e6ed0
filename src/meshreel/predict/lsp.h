/// Least squares prediction: weights of the neighbours that fit the components known so far.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "meshreel/predict/small_solve.h"

namespace meshreel::predict {

/// Predicts the components of a vertex one after the other; each one learned sharpens the weights for the next.
/// @cost a component of N neighbours: O(N^3).  @source thesis 8.3.1
class Lsp {
public:
    /// step: D, quantisation step of all values, > 0.
    explicit Lsp(double step) : ridge_(step * step) {}

    /// A new vertex, of so many neighbours, 1 .. most_neighbours.
    void start(std::size_t neighbours);
    /// The next component, from the neighbours' values of it.  @source thesis (8.4)-(8.6)
    double guess(std::span<const double> y);
    /// What the component is: one more row of (8.5).
    void learn(std::span<const double> y, double value);

private:
    double ridge_; ///< how strongly weights are drawn to 1 / N
    std::size_t n_ = 0, known_ = 0;
    std::array<double, most_neighbours * most_neighbours> gram_; ///< of the rows of (8.5): A^T A, lower triangle
    std::array<double, most_neighbours> right_;                  ///< A^T v
    std::array<std::size_t, most_neighbours> first_equal_;       ///< the first neighbour that was equal so far
    SmallSolve system_;
};

} // namespace meshreel::predict
