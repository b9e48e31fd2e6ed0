/// Connectivity as codecs see it: vertices numbered in the order the Edgebreaker traversal meets them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/base/id.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::connectivity {

/// Where the traversal stood when it met a vertex. Each is an earlier vertex, or none.
///
///        tip
///       /   \             The gate is the edge left-right; the triangle below it is known,
///   left --- right        the triangle above it is new, and so is its tip.
///       \   /
///      opposite
struct Gate {
    VertexId left, right, opposite;
};

/// Vertices 0 .. W-1 in the order met. Vertices without a triangle come last, their gates empty. Unlike vertices that
/// closed a hole for the traversal's sake, every one of these is real.
struct Surface {
    std::uint32_t vertex_count = 0;  ///< W
    std::vector<Triangle> triangles; ///< [T] in the order met, oriented and rotated as in the input
    std::vector<Gate> gates;         ///< [W], gate i is where vertex i was met
};

/// A surface together with the way back to the numbering it came from.
struct Trace {
    Surface surface;
    std::vector<std::uint32_t> vertex_of; ///< [W] input vertex of each surface vertex
    std::vector<std::uint32_t> corner_of; ///< [3T] input corner (3 t + i) of each surface corner
};

} // namespace meshreel::connectivity
