/// Neighbourhood average: every component is the mean of the neighbours'.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace meshreel::predict {

/// The mean of the neighbours' values of one component; there is at least one.  @source thesis (8.4)
inline double average(std::span<const double> neighbours)
{
    double sum = 0;
    for (double value : neighbours) sum += value;
    return sum / static_cast<double>(neighbours.size()); // (8.4)
}

/// The average, told the way progressive predictors are: a vertex' components one after the other.
class Average {
public:
    /// step: D, quantisation step of all values.
    explicit Average(double /*step*/) {}
    /// A new vertex, of so many neighbours.
    void start(std::size_t /*neighbours*/) {}
    /// The next component, from the neighbours' values of it.
    double guess(std::span<const double> y) { return average(y); }
    /// What the component is.
    void learn(std::span<const double> /*y*/, double /*value*/) {}
};

} // namespace meshreel::predict
