/// How an animation's triangles become glTF nodes, primitives and vertex sets.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::io {

constexpr std::uint32_t no_corner = 0xffffffff;

/// The vertices that some primitives share, in the animation's order; a vertex with several values of a corner
/// attribute stands several times.
struct GltfVertexSet {
    std::vector<std::uint32_t> sources; ///< the animation's vertex
    std::vector<std::uint32_t> corners; ///< the first corner that shows it; no_corner: no triangle does
};

struct GltfPrimitive {
    std::uint32_t set = 0;
    std::uint32_t material = no_corner;
    std::vector<std::uint32_t> indices; ///< three a triangle, into the set
};

struct GltfNodeOut {
    std::string name;
    std::string mesh;
    std::vector<std::size_t> primitives;
};

struct GltfLayout {
    std::vector<GltfVertexSet> sets;
    std::vector<GltfPrimitive> primitives;
    std::vector<GltfNodeOut> nodes;
};

/// One primitive a group and material, in the order of their first triangles, triangles in their order; one node a
/// node of the groups' names. Primitives that share vertices share a set. Vertices without triangle follow the vertex
/// before them. At least one triangle.  @cost O(T log T + V)
GltfLayout gltf_layout(const Animation& animation);

} // namespace meshreel::io
