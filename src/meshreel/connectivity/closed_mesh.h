/// Any triangle list as closed, oriented manifold components: what the Edgebreaker needs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/connectivity/adjacency.h"

namespace meshreel::connectivity {

/// Vertices with several fans are split into one copy a fan; each boundary loop is closed by a fan of triangles around
/// a dummy vertex. Thus every edge has two triangles and every copy one closed fan.
struct ClosedMesh {
    std::uint32_t real_triangles = 0;     ///< the first ones are the input's, turned; the others hold a dummy
    std::vector<std::uint32_t> twin;      ///< [3T'] every one valid
    std::vector<std::uint32_t> copy_at;   ///< [3T'] copy at each corner
    std::vector<std::uint32_t> vertex_of; ///< [copies] vertex of each copy, none: a dummy

    std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(twin.size() / 3); }
};

/// @cost O(T); T' <= 4T.
ClosedMesh close(const Adjacency& mesh);

} // namespace meshreel::connectivity
