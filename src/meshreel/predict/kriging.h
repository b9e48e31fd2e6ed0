/// Kriging: the weights with which a point's neighbours interpolate it best, given what is already known of them all.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meshreel::predict {

/// How alike values at two points are taken to be.
struct Likeness {
    double linear = 150.0;     ///< weight of what is linear in the known values against what only is smooth, >= 0
    double squared_bend = 1.0; ///< c^2 of the multiquadric, > 0: the distance, squared, up to which values are smooth
    double nugget = 0.01; ///< noise of the neighbours' values, relative to the values' change over the mean distance
    double noise = 0.0;   ///< noise that does not shrink with the distance: noise / mean distance adds to the nugget
};

/// The neighbours of a few points, solved side by side: what is known of each, less what is known of its point.
///
/// With e_i the difference of neighbour i, in units of the mean |e_i|, covariances are a - phi(|e_i - e_j|) + linear *
/// e_i . e_j with phi(r) = sqrt(c^2 + r^2) - c, a beyond its largest value; the best unbiased linear estimate follows
/// from the n x n system. The first term interpolates as (8.7) does; the second makes weights that reproduce, in the
/// least squares sense, the values already known, as (8.5) does.
/// @source R. L. Hardy 1971 (multiquadrics); G. Matheron 1963 (kriging)
class Kriging {
public:
    static constexpr std::size_t most = 16; ///< neighbours
    static constexpr std::size_t lanes = 4; ///< points

    using Lanes = std::array<double, lanes>; ///< a number of each point
    using Square = std::array<std::array<Lanes, most>, most>;

    /// For points of up to `dimensions` known values.
    explicit Kriging(std::size_t dimensions) : e_(dimensions * most) {}

    /// The differences of known value k, all neighbours' side by side.
    std::span<double, most> differences(std::size_t k) { return std::span<double, most>(e_.data() + most * k, most); }

    /// Takes `count` differences of known values 0 .. known-1, as they are now, for those of a point, below `lanes`.
    /// @cost O(count^2 known).
    void set(std::size_t point, std::size_t count, std::size_t known);

    /// Weights of the `count` neighbours, 1 <= count <= most, of each point set, of sum 1. + - * / sqrt only.
    /// @cost O(count^3).
    std::array<Lanes, most> weights(std::size_t count, const Likeness& likeness) const;

private:
    std::vector<double> e_; ///< [dimensions x most]
    Square G_{};            ///< e_i . e_j for j <= i
};

} // namespace meshreel::predict
