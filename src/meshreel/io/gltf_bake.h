/// Bakes a glTF scene: where every vertex is at a time, nodes, skins and morph targets applied.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/gltf_geometry.h"

namespace meshreel::io {

/// One vertex set in one pose: a run of the animation's vertices. Nodes that show it in the same pose share them, as a
/// body does that is one list of vertices in groups.
struct GltfPart {
    std::uint32_t node = 0;  ///< the first of these nodes
    std::uint32_t set = 0;   ///< into GltfBody::sets
    std::uint32_t first = 0; ///< its first vertex in the animation
    bool skinned = false;
};

/// A node with a mesh.
struct GltfShown {
    std::uint32_t node = 0;
    std::vector<std::uint32_t> parts; ///< into GltfBody::parts, one for each of the mesh's GltfMesh::sets
};

/// Everything that is shown, in node order.
struct GltfBody {
    std::vector<GltfMesh> meshes; ///< by mesh number; those not shown stay empty
    std::vector<GltfVertices> sets;
    std::vector<GltfPart> parts;
    std::vector<GltfShown> shown;
    std::uint32_t vertex_count = 0;
};

/// Reads every mesh that a visible node shows; the clip, which may be null, says which nodes move alike.
/// @fails bad_input: no triangle mesh; too many vertices; a joint out of range.
Result<GltfBody> read_gltf_body(const GltfDocument& document, const GltfScene& scene, const GltfClip* clip,
                                const std::function<void(std::string)>& warn);

/// The scene at one time.
struct GltfPose {
    std::vector<Affine> world;                ///< a node
    std::vector<std::vector<double>> weights; ///< a node
    std::vector<std::vector<Affine>> joints;  ///< a skin: world times inverse bind matrix, a joint
};

/// clip may be null: the rest pose.
GltfPose pose_at(const GltfScene& scene, const GltfClip* clip, double time_s);

/// sum_j w_j G_j B_j of vertex v; false where no joint moves it.
bool blend(const GltfVertices& vertices, std::size_t v, const std::vector<Affine>& joints, Affine& blended);

/// Multiplications that one frame takes, roughly.
std::uint64_t work_of(const GltfScene& scene, const GltfBody& body);

/// Positions of all vertices, world space, rounded once. out: [V x 3].
/// @source glTF 2.0, 3.7.3.3: p = sum_j w_j G_j B_j (rest + sum_k m_k target_k)
void bake(const GltfScene& scene, const GltfBody& body, const GltfPose& pose, std::span<float> out);

/// Turns normals and tangents of the first frame's pose into world space, as unit vectors in float32. Vertices that the
/// pose only moves or scales alike in all directions keep theirs bit for bit; so do all where every vertex does.
void turn_normals(const GltfScene& scene, const GltfBody& body, const GltfPose& pose, Animation& animation);

} // namespace meshreel::io
