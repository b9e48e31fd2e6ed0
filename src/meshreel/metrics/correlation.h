/// How well what was measured agrees with what people saw: Pearson's, Spearman's and Kendall's coefficients.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace meshreel::metrics {

/// Where the coefficient of the whole population lies with a probability of 95 %, within [-1, 1].
struct Interval {
    double low = 0.0, high = 0.0;
};

/// A coefficient in [-1, 1], or a word why there is none. Never a NaN.
struct Correlation {
    std::optional<double> value;
    std::optional<Interval> interval; ///< of a value of -1 or 1: that point
    std::string_view lacking = {};    ///< why value is missing, or else interval; empty: nothing is
};

/// Linear agreement, (7.15) as estimated by (7.16). Interval: Fisher's z = atanh r with the deviation 1 / sqrt(n - 3); of
/// four pairs or more. x, y: [n] finite.
/// None: n < 3, or x or y is constant.  @cost O(n).
Correlation pearson(std::span<const double> x, std::span<const double> y);

/// Agreement in order: Pearson's coefficient of ranks, equal values sharing the mean of theirs. Interval: Bonett and
/// Wright's (2000), deviation sqrt((1 + r^2 / 2) / (n - 3)) of z; of four pairs or more. Else as pearson().
/// @cost O(n log n).
Correlation spearman(std::span<const double> x, std::span<const double> y);

/// Pairs in the same order less pairs in opposite order, tau-b: as a share of those that neither x nor y ties (the geometric
/// mean of both counts). Interval: Fieller, Hartley and Pearson's (1957), deviation sqrt(0.437 / (n - 4)) of z; of five
/// pairs or more. Else as pearson().  @cost O(n log n), by Knight's way.
Correlation kendall(std::span<const double> x, std::span<const double> y);

/// One row of the table of coefficients.
struct Coefficient {
    std::string_view name;   ///< "pearson", as in JSON
    std::string_view title;  ///< "Pearson"
    std::string_view source; ///< "thesis (7.16)"
    Correlation (*of)(std::span<const double> x, std::span<const double> y);
};

/// All of them, in the order of the documentation.
std::span<const Coefficient> coefficients();

} // namespace meshreel::metrics
