/// A colour bar with its numbers as triangles, to stand beside a mesh in any viewer.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cli/pictures/colour_map.h"

namespace meshreel::cli {

struct Bounds3 {
    static constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{far, far, far}, high{-far, -far, -far};
};

/// What stands over a colour bar, a line each.
struct ColourBarWords {
    std::string title, unit, of;
};

struct ColourBarMesh {
    std::vector<float> positions;       ///< x y z of each vertex
    std::vector<std::uint16_t> colours; ///< linear red, green, blue, opacity of each vertex, 65535: 1
    std::vector<std::uint32_t> indices; ///< three a triangle
};

/// An upright bar to the right of a body, y up, that faces +z.
ColourBarMesh colour_bar_mesh(const Bounds3& body, const Scale& scale, const ColourBarWords& words);

} // namespace meshreel::cli
