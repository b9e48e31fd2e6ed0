/// A picture in memory and its way into a PNG file.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel::cli {

/// Linear red, green, blue, [0, 1] each.
using Colour = std::array<float, 3>;

/// Rows of pixels from the top, linear light, with an opacity so that it can stand on any background.
struct Image {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<Colour> colours; ///< [height x width], premultiplied by the opacity
    std::vector<float> opacity;  ///< [height x width], [0, 1]

    Image() = default;
    Image(std::size_t columns, std::size_t rows);
};

/// A channel of the usual sRGB as linear light.
float linear_of(std::uint8_t channel);

/// "#rrggbb" of the usual sRGB as linear light. @pre seven characters.
Colour colour_of(const char* hex);

/// The mean of `times` x `times` pixels becomes one: smooth edges for a picture drawn too large.
Image shrink(const Image& large, std::size_t times);

/// A part of an image, pixels.
struct Box {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// Lays a colour over a box with upright sides, its corners rounded; what lies outside the image is left out.
void fill(Image& image, const Box& box, const Colour& colour, double radius = 0.0);

/// Lays `small` over `image`, its upper left pixel at a place.
void paste(Image& image, const Image& small, std::size_t x, std::size_t y);

/// Lays a colour over one pixel, [0, 1] of it.
void blend(Image& image, std::size_t pixel, const Colour& colour, float share);

/// An 8-bit sRGB PNG with opacity. @fails runtime: libpng refuses.
Result<Bytes> png(const Image& image);

} // namespace meshreel::cli
