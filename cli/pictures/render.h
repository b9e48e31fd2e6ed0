/// Draws a triangle mesh into an image: parallel projection, z-buffer, smooth shading.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cli/pictures/image.h"
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

/// From where a camera looks.
struct View {
    Axis up = Axis::unknown; ///< unknown: y
    double turn = 0.0;     ///< radians about the upright axis, from the front, counted as the object turns to the left
    std::size_t width = 0; ///< pixels
};

/// Positions of one frame, [V x 3].
using Pose = std::span<const float>;

/// Looks from the front, a little from the left and from above, so that all poses fit the width with a margin. The
/// height follows from the shape, between half the width and 1.2 of it. @pre poses not empty.
Camera look_at(std::span<const Pose> poses, const View& view);

/// A camera for each set of poses, which it shows all; the cameras are equal in scale and size, and from one to the next
/// the object has turned by the same angle, once around in all. @pre no set is empty.
std::vector<Camera> turntable(std::span<const std::vector<Pose>> poses, const View& first);

/// What is drawn.
struct Scene {
    std::span<const Triangle> triangles; ///< none: every vertex is drawn as a ball
    std::span<const float> positions;    ///< [V x 3]
    std::span<const Colour> colours;     ///< [V]
    double relief = 1.0;                 ///< how much the light models the surface: 0, the bare colours, to 1
};

/// Draws the scene, both sides of every triangle lit alike.
Image render(const Scene& scene, const Camera& camera);

} // namespace meshreel::cli
