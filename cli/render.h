/// Draws a triangle mesh into an image: parallel projection, z-buffer, smooth shading.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "cli/image.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

/// A parallel projection: screen x to the right, y down, depth away from the eye, in pixels.
struct Camera {
    std::array<std::array<double, 3>, 3> axes{}; ///< right, down, away: unit vectors in model space
    std::array<double, 2> centre{};              ///< the projected point in the middle of the image, model units
    double pixels_per_unit = 1.0;
    std::size_t width = 0;  ///< pixels
    std::size_t height = 0; ///< pixels
};

/// Looks from the front, a little from the left and from above, so that every given frame fits the width with a margin.
/// The height follows from the shape, between half the width and the width. @pre frames not empty.
Camera look_at(const Animation& animation, std::span<const std::size_t> frames, Axis up, std::size_t width);

/// What is drawn.
struct Scene {
    std::span<const Triangle> triangles;
    std::span<const float> positions; ///< [V x 3]
    std::span<const Colour> colours;  ///< [V]
    double relief = 1.0;              ///< how much the light models the surface: 0, the bare colours, to 1
};

/// Draws the scene, both sides of every triangle lit alike.
Image render(const Scene& scene, const Camera& camera);

} // namespace meshreel::cli
