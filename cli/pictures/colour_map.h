/// From an error to a colour, and the round numbers that stand beside the colours.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/pictures/image.h"

namespace meshreel::cli {

/// The colour map viridis (Smith, van der Walt; CC0), ten of its colours: steps look equally large, and do so too for
/// who sees no red or no green, and in grey.
inline constexpr std::array viridis_colours{"#440154", "#482878", "#3e4989", "#31688e", "#26828e",
                                            "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"};

/// sRGB of x in [0, 1]; what lies outside has the colour of the end.
std::array<std::uint8_t, 3> viridis_bytes(double x);
/// The same as linear light.
Colour viridis(double x);

/// What a colour bar shows: 0 to `top` in `parts` round steps.
struct Scale {
    double top = 1.0;
    int parts = 5;

    double tick(int i) const { return top * i / parts; }
    /// Where an error stands between 0 and the top; an infinite one at the top.
    double place(double error) const { return error < top ? error / top : 1.0; }
};

/// From 0 to the smallest round number that is not below the largest error; to 1 where there is no error.
Scale scale_up_to(double largest);
/// From 0 to exactly `top`, > 0.
Scale scale_of(double top);

/// "0.0125", "1.2e-07": four digits.
std::string short_number(double value);

} // namespace meshreel::cli
