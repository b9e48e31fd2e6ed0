/// Poses a glTF scene and bakes its vertices, in double.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_bake.h"

#include <algorithm>

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

/// Every joint that moves a vertex must be in the skin.
Status check_joints(const GltfVertices& vertices, const GltfSkin& skin)
{
    for (std::size_t i = 0; i < vertices.joints.size(); ++i)
        if (vertices.joints[i] >= skin.joints.size() && vertices.weights[i] != 0)
            return vertices.primitive.member("attributes")
                .wrong(concat("vertex ", i / vertices.influences, " names joint ", vertices.joints[i],
                              " of a skin with ", skin.joints.size()));
    return Ok{};
}

Status add_node(const GltfDocument& document, const GltfScene& scene, std::uint32_t number, GltfBody& body)
{
    const GltfNode& node = scene.nodes[number];
    const GltfMesh& mesh = body.meshes[node.mesh];
    for (std::uint32_t s = 0; s < mesh.vertices.size(); ++s) {
        const GltfVertices& vertices = mesh.vertices[s];
        GltfPart part{number, node.mesh, s, body.vertex_count, node.skin != gltf_none && vertices.influences > 0};
        if (part.skinned) MESHREEL_CHECK(check_joints(vertices, scene.skins[node.skin]));
        const std::uint64_t total = std::uint64_t{body.vertex_count} + vertices.count;
        MESHREEL_CHECK(within(total, std::min<std::uint64_t>(document.limits.max_vertices, gltf_none - 1), "nodes"));
        body.vertex_count = static_cast<std::uint32_t>(total);
        body.parts.push_back(part);
    }
    return Ok{};
}

/// Rest position plus the morph targets whose weight is not 0.
std::vector<double> morphed(const GltfVertices& vertices, const std::vector<double>& weights)
{
    std::vector<double> positions(vertices.count * 3ul);
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] = static_cast<double>(vertices.rest.values[i]) * vertices.rest.unit;
    for (std::size_t t = 0; t < std::min(weights.size(), vertices.targets.size()); ++t) {
        const Numbers& target = vertices.targets[t];
        const double factor = weights[t] * target.unit;
        if (factor == 0 || target.values.empty()) continue;
        for (std::size_t i = 0; i < positions.size(); ++i)
            positions[i] += factor * static_cast<double>(target.values[i]);
    }
    return positions;
}

void apply(const GltfClip& clip, double time_s, std::vector<Trs>& local, std::vector<std::vector<double>>& weights)
{
    for (const GltfChannel& channel : clip.channels) {
        const GltfSampler& sampler = clip.samplers[channel.sampler];
        Trs& trs = local[channel.node];
        switch (channel.path) {
        case AnimatedPath::translation:
            sample(sampler, channel.path, time_s, trs.translation);
            break;
        case AnimatedPath::rotation:
            sample(sampler, channel.path, time_s, trs.rotation);
            break;
        case AnimatedPath::scale:
            sample(sampler, channel.path, time_s, trs.scale);
            break;
        case AnimatedPath::weights:
            weights[channel.node].resize(sampler.width);
            sample(sampler, channel.path, time_s, weights[channel.node]);
            break;
        }
    }
}

} // namespace

bool blend(const GltfVertices& vertices, std::size_t v, const std::vector<Affine>& joints, Affine& blended)
{
    blended.m.fill(0);
    bool moved = false;
    for (std::size_t i = v * vertices.influences; i < (v + 1) * vertices.influences; ++i) {
        const double weight = vertices.weights[i];
        if (weight == 0) continue;
        moved = true;
        for (std::size_t k = 0; k < 12; ++k) blended.m[k] += weight * joints[vertices.joints[i]].m[k];
    }
    return moved;
}

Result<GltfBody> read_gltf_body(const GltfDocument& document, const GltfScene& scene,
                                const std::function<void(std::string)>& warn)
{
    GltfBody body;
    body.meshes.resize(document.count("meshes"));
    std::vector<bool> read(body.meshes.size());
    for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const GltfNode& node = scene.nodes[n];
        if (!node.visible || node.mesh == gltf_none) continue;
        if (!read[node.mesh]) {
            MESHREEL_TRY(body.meshes[node.mesh], read_gltf_mesh(document, node.mesh, warn));
            read[node.mesh] = true;
        }
        MESHREEL_CHECK(add_node(document, scene, n, body));
    }
    if (body.vertex_count == 0) return bad_input("the scene shows no triangle mesh", "nodes");
    return body;
}

GltfPose pose_at(const GltfScene& scene, const GltfClip* clip, double time_s)
{
    GltfPose pose;
    std::vector<Trs> local(scene.nodes.size());
    pose.world.resize(scene.nodes.size());
    pose.weights.resize(scene.nodes.size());
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        local[n] = scene.nodes[n].trs;
        pose.weights[n] = scene.nodes[n].weights;
    }
    if (clip != nullptr) apply(*clip, time_s, local, pose.weights);
    for (std::uint32_t n : scene.order) {
        const GltfNode& node = scene.nodes[n];
        const Affine own = node.has_matrix ? node.matrix : local[n].matrix();
        pose.world[n] = node.parent == gltf_none ? own : pose.world[node.parent] * own;
    }
    pose.joints.resize(scene.skins.size());
    for (std::size_t s = 0; s < scene.skins.size(); ++s)
        for (std::size_t j = 0; j < scene.skins[s].joints.size(); ++j)
            pose.joints[s].push_back(pose.world[scene.skins[s].joints[j]] * scene.skins[s].inverse_bind[j]);
    return pose;
}

void bake(const GltfScene& scene, const GltfBody& body, const GltfPose& pose, std::span<float> out)
{
    for (const GltfPart& part : body.parts) {
        const GltfVertices& vertices = body.meshes[part.mesh].vertices[part.set];
        const std::vector<double> rest = morphed(vertices, pose.weights[part.node]);
        const std::uint32_t skin = scene.nodes[part.node].skin;
        Affine matrix = pose.world[part.node];
        for (std::size_t v = 0; v < vertices.count; ++v) {
            std::array<double, 3> p = {rest[v * 3], rest[v * 3 + 1], rest[v * 3 + 2]};
            if (!part.skinned || blend(vertices, v, pose.joints[skin], matrix)) p = matrix(p);
            for (std::size_t axis = 0; axis < 3; ++axis) out[(part.first + v) * 3 + axis] = static_cast<float>(p[axis]);
        }
    }
}

} // namespace meshreel::io
