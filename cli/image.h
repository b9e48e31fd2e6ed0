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

/// "#rrggbb" of the usual sRGB as linear light. @pre seven characters.
Colour colour_of(const char* hex);

/// The mean of `times` x `times` pixels becomes one: smooth edges for a picture drawn too large.
Image shrink(const Image& large, std::size_t times);

/// An 8-bit sRGB PNG with opacity. @fails runtime: libpng refuses.
Result<Bytes> png(const Image& image);

} // namespace meshreel::cli
