/// Measures frame by frame: one small curve each, over the same times, as an SVG.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

namespace meshreel::cli {

/// One measure over time.
struct Curve {
    std::string title;          ///< "RMS distance"
    std::string unit;           ///< "%", ""
    double overall = 0.0;       ///< the measure of the whole animation
    std::vector<double> values; ///< [F]; what is infinite is drawn at the border
    bool more_is_better = false;
};

/// An SVG with light and dark colours, as the reader's system has them. Every curve has its axes with units, a line at
/// the value of the whole, a mark at its worst frame, and tells the value of a frame under the pointer.
/// @pre all curves have times_s.size() values, at least one.
std::string curves_svg(std::span<const Curve> curves, std::span<const double> times_s, const std::string& title);

} // namespace meshreel::cli
