/// The meshes of a glTF scene: which vertices stand where, what moves them, how they are joined to triangles.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/gltf_scene.h"

namespace meshreel::io {

/// The vertices that one or more primitives of a mesh share.
struct GltfVertices {
    Json primitive;                    ///< the first of these primitives
    std::uint32_t count = 0;           ///< V'
    Numbers rest;                      ///< [V' x 3]
    std::vector<Numbers> targets;      ///< morph targets, each [V' x 3] or empty
    std::size_t influences = 0;        ///< joints a vertex: 4 a set; 0: not skinned
    std::vector<std::uint32_t> joints; ///< [V' x influences]
    std::vector<double> weights;       ///< [V' x influences], each vertex's sum 1, or all 0
};

/// One primitive's triangles.
struct GltfTriangles {
    std::size_t vertices = 0;  ///< index into the mesh's list of vertex sets
    std::size_t primitive = 0; ///< its number in the mesh
    std::uint32_t material = gltf_none;
    std::vector<Triangle> triangles; ///< in 0 .. V'-1
};

struct GltfMesh {
    std::string name;
    std::vector<GltfVertices> vertices;
    std::vector<GltfTriangles> primitives;
};

/// Reads meshes[number]; strips and fans become triangles; points and lines are told to `warn` and left out.
/// @fails bad_input: an index out of range, attributes that disagree in count, ...
Result<GltfMesh> read_gltf_mesh(const GltfDocument& document, std::size_t number,
                                const std::function<void(std::string)>& warn);

} // namespace meshreel::io
