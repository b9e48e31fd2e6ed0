/// Prediction by radial basis functions: the next component as a function of those known.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "meshreel/predict/small_solve.h"

namespace meshreel::predict {

/// phi(r) = r^1.75, from s = r^2, by square roots alone.
double radial(double s);

/// Predicts the components of a vertex one after the other. Those known are where the vertex is, among its
/// neighbours; the next one is interpolated there.
/// @cost a component of N neighbours: O(N^3).  @source thesis 8.3.2
class Rbf {
public:
    /// step: D, quantisation step of all values, > 0.
    explicit Rbf(double step) : equal_(step * step) {}

    /// A new vertex, of so many neighbours, 1 .. most_neighbours.
    void start(std::size_t neighbours);
    /// The next component, from the neighbours' values of it.  @source thesis (8.7)-(8.10)
    double guess(std::span<const double> y);
    /// What the component is: one more dimension of the space.
    void learn(std::span<const double> y, double value);

private:
    double apart(std::size_t i, std::size_t j) const { return apart_[i * most_neighbours + j]; }
    std::size_t gather(std::span<const double> y);
    double interpolate(std::size_t N);

    double equal_; ///< neighbours whose squared distance is no larger are one
    std::size_t n_ = 0;
    std::array<double, most_neighbours * most_neighbours> apart_; ///< squared distances of neighbours i, j < i
    std::array<double, most_neighbours> away_;                    ///< of the vertex from each
    std::array<std::size_t, most_neighbours> kept_;               ///< one neighbour of each place
    std::array<double, most_neighbours> mean_;                    ///< of the values at each place
    SmallSolve system_;
};

} // namespace meshreel::predict
