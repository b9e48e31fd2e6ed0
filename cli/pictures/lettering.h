/// A small alphabet of strokes, for pictures that must bring their letters along: PNG, and meshes.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "cli/pictures/image.h"

namespace meshreel::cli {

/// A line from point to point, x to the right, y up from the line that letters stand on, in heights of a capital.
using Stroke = std::vector<std::array<double, 2>>;

/// The strokes of a text, one after the other; a point of ink is a stroke of one point. Latin letters, digits and the
/// usual signs; any other letter is drawn as a question mark.
std::vector<Stroke> strokes_of(std::string_view text);

/// How far a text reaches, in heights of a capital.
double text_width(std::string_view text);

/// Where a text stands with respect to its point.
enum class Align { left, middle, right };

/// How a text looks.
struct Pen {
    double size = 10.0; ///< height of a capital, pixels
    Colour colour{};
    double weight = 0.13; ///< width of a stroke, in heights of a capital
    Align align = Align::left;
};

/// Draws a text that stands on the height y.
void write(Image& image, std::array<double, 2> at, std::string_view text, const Pen& pen);

} // namespace meshreel::cli
