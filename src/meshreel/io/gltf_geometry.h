/// The meshes of a glTF scene: which vertices stand where, what moves them, how they are joined to triangles.
// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "meshreel/io/gltf_scene.h"

namespace meshreel::io {

/// The vertices that primitives with the same accessors share, of one mesh or of several.
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
    std::size_t vertices = 0;  ///< index into GltfMesh::sets
    std::size_t primitive = 0; ///< its number in the mesh
    std::uint32_t material = gltf_none;
    std::vector<Triangle> triangles; ///< in 0 .. V'-1
};

struct GltfMesh {
    std::string name;
    std::vector<std::uint32_t> sets; ///< of vertices: into GltfVertexSets::sets
    std::vector<GltfTriangles> primitives;
};

/// Each set of vertices once.
struct GltfVertexSets {
    std::vector<GltfVertices> sets;
    std::map<std::string, std::uint32_t> numbers; ///< by the accessors of attributes and targets
};

/// Reads meshes[number]; strips and fans become triangles; points and lines are told to `warn` and left out. What no mesh
/// before had is added to the sets. @fails bad_input: an index out of range, attributes that disagree in count, ...
Result<GltfMesh> read_gltf_mesh(const GltfDocument& document, std::size_t number, GltfVertexSets& vertices,
                                const std::function<void(std::string)>& warn);

} // namespace meshreel::io
