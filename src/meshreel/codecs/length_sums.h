/// What is known of a length that should stay the same, summed up over frames.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace meshreel::codecs {

/// Sums over frames of what should be 0 on the mean, less `base`, which it is in the first frame; and of the squares.
struct LengthSums {
    double base = 0.0, sum = 0.0, squares = 0.0;

    void add(double value)
    {
        const double more = value - base;
        sum += more;
        squares += more * more;
    }
    double mean(double F) const { return base + sum / F; }
    double variance(double F) const { return std::max(0.0, squares / F - (sum / F) * (sum / F)); }
};

/// The median of the variances over F frames. @pre sums is not empty
inline double middle_variance(std::span<const LengthSums> sums, double F)
{
    std::vector<double> variances;
    for (const LengthSums& of_one : sums) variances.push_back(of_one.variance(F));
    const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
    std::nth_element(variances.begin(), middle, variances.end());
    return *middle;
}

} // namespace meshreel::codecs
