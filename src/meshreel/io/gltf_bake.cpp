/// Poses a glTF scene and bakes its vertices, in double.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_bake.h"

#include <algorithm>
#include <map>

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

/// All that says where a node puts a vertex, at any time: where two nodes' are equal, so are their poses.
std::vector<std::vector<double>> poses_of(const GltfScene& scene, const GltfClip* clip)
{
    std::vector<std::vector<double>> poses;
    for (const GltfNode& node : scene.nodes) {
        std::vector<double>& pose = poses.emplace_back();
        const auto add = [&](const auto& numbers) { pose.insert(pose.end(), numbers.begin(), numbers.end()); };
        add(std::array<double, 3>{static_cast<double>(node.parent), static_cast<double>(node.skin),
                                  node.has_matrix ? 1.0 : 0.0});
        add(node.matrix.m);
        add(node.trs.translation);
        add(node.trs.rotation);
        add(node.trs.scale);
        pose.push_back(static_cast<double>(node.weights.size()));
        add(node.weights);
    }
    if (clip == nullptr) return poses;
    for (const GltfChannel& channel : clip->channels) {
        poses[channel.node].push_back(static_cast<double>(channel.path));
        poses[channel.node].push_back(static_cast<double>(channel.sampler));
    }
    return poses;
}

/// Adds nodes to a body.
struct BodyBuilder {
    const GltfDocument& document;
    const GltfScene& scene;
    std::vector<std::vector<double>> poses; ///< a node
    GltfBody body;
    std::map<std::pair<std::uint32_t, std::vector<double>>, std::uint32_t> parts; ///< by set and pose

    Result<std::uint32_t> part_of(std::uint32_t number, std::uint32_t set);
    Status add(std::uint32_t number);
};

/// The part of a node that holds a set: one that there is, or a new one.
Result<std::uint32_t> BodyBuilder::part_of(std::uint32_t number, std::uint32_t set)
{
    const auto [place, fresh] = parts.try_emplace({set, poses[number]}, static_cast<std::uint32_t>(body.parts.size()));
    if (!fresh) return place->second;
    MESHREEL_CHECK(document.budget->take(poses[number].size() * sizeof(double), document.item("nodes", number)));
    const std::uint32_t skin = scene.nodes[number].skin;
    const GltfVertices& vertices = body.sets[set];
    const GltfPart part{number, set, body.vertex_count, skin != gltf_none && vertices.influences > 0};
    if (part.skinned) MESHREEL_CHECK(check_joints(vertices, scene.skins[skin]));
    const std::uint64_t total = std::uint64_t{body.vertex_count} + vertices.count;
    MESHREEL_CHECK(within(total, std::min<std::uint64_t>(document.limits.max_vertices, gltf_none - 1), "nodes"));
    body.vertex_count = static_cast<std::uint32_t>(total);
    body.parts.push_back(part);
    return place->second;
}

Status BodyBuilder::add(std::uint32_t number)
{
    GltfShown shown{number, {}};
    for (const std::uint32_t set : body.meshes[scene.nodes[number].mesh].sets) {
        MESHREEL_TRY(const std::uint32_t part, part_of(number, set));
        shown.parts.push_back(part);
    }
    body.shown.push_back(std::move(shown));
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

Result<GltfBody> read_gltf_body(const GltfDocument& document, const GltfScene& scene, const GltfClip* clip,
                                const std::function<void(std::string)>& warn)
{
    BodyBuilder builder{document, scene, poses_of(scene, clip), {}, {}};
    GltfBody& body = builder.body;
    const auto is_shown = [&](const GltfNode& node) { return node.visible && node.mesh != gltf_none; };
    body.meshes.resize(document.count("meshes"));
    std::vector<bool> read(body.meshes.size());
    GltfVertexSets vertices;
    for (const GltfNode& node : scene.nodes) {
        if (!is_shown(node) || read[node.mesh]) continue;
        MESHREEL_TRY(body.meshes[node.mesh], read_gltf_mesh(document, node.mesh, vertices, warn));
        read[node.mesh] = true;
    }
    body.sets = std::move(vertices.sets);
    for (std::uint32_t n = 0; n < scene.nodes.size(); ++n)
        if (is_shown(scene.nodes[n])) MESHREEL_CHECK(builder.add(n));
    if (body.vertex_count == 0) return bad_input("the scene shows no triangle mesh", "nodes");
    return std::move(body);
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

std::uint64_t work_of(const GltfScene& scene, const GltfBody& body)
{
    constexpr std::uint64_t matrix = 12, product = 36, local = 30;
    std::uint64_t work = scene.nodes.size() * (local + product);
    for (const GltfSkin& skin : scene.skins) work += skin.joints.size() * product;
    for (const GltfPart& part : body.parts) {
        const GltfVertices& vertices = body.sets[part.set];
        work += vertices.count * (matrix * (1 + vertices.influences) + 3 * vertices.targets.size());
    }
    return work;
}

void bake(const GltfScene& scene, const GltfBody& body, const GltfPose& pose, std::span<float> out)
{
    for (const GltfPart& part : body.parts) {
        const GltfVertices& vertices = body.sets[part.set];
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
