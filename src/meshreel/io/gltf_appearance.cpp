/// Gathers triangles, attributes, materials and names of a glTF scene in the order in which its vertices are baked.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_appearance.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/gltf_names.h"

namespace meshreel::io {

namespace {

/// An attribute as it grows, and the vertices that have it.
struct GltfColumn {
    Attribute attribute;
    std::vector<std::array<std::uint32_t, 2>> runs; ///< first vertex, count
    std::uint64_t covered = 0;
};

using GltfColumns = std::vector<GltfColumn>;

GltfColumn& column_for(GltfColumns& columns, const std::string& name, const Accessor& values)
{
    const auto fits = [&](const GltfColumn& column) {
        const Attribute& a = column.attribute;
        return a.type == values.type && a.components == values.components && a.normalized == values.normalized;
    };
    bool taken = false;
    for (GltfColumn& column : columns) {
        if (column.attribute.name.substr(0, column.attribute.name.find('|')) != name) continue;
        if (fits(column)) return column;
        taken = true;
    }
    GltfColumn fresh;
    fresh.attribute = {name, Domain::vertex, values.type, values.components, values.normalized, {}, {}};
    if (taken) fresh.attribute.name = variant_name(fresh.attribute);
    columns.push_back(std::move(fresh));
    return columns.back();
}

Status gather(const GltfSource& source, const GltfVertices& vertices, std::uint32_t first, GltfColumns& columns)
{
    const Json attributes = vertices.primitive.member("attributes");
    for (const auto& item : attributes.value->items()) {
        const std::string& semantic = item.key();
        const std::optional<std::string> name = attribute_name(semantic);
        if (!name) {
            const bool baked = semantic == "POSITION" || semantic.compare(0, 7, "JOINTS_") == 0 ||
                               semantic.compare(0, 8, "WEIGHTS_") == 0;
            if (!baked && source.warn)
                source.warn(concat(attributes.path, ".", semantic, ": is no attribute of glTF and left out"));
            continue;
        }
        MESHREEL_TRY(const Accessor found, accessor(source.document, attributes.member(semantic.c_str())));
        if (found.count != vertices.count)
            return attributes.member(semantic.c_str())
                .wrong(concat(found.count, " values for ", vertices.count, " vertices"));
        MESHREEL_TRY(const Bytes packed, packed_values(found));
        GltfColumn& column = column_for(columns, *name, found);
        column.attribute.values.insert(column.attribute.values.end(), packed.begin(), packed.end());
        column.runs.push_back({first, vertices.count});
        column.covered += vertices.count;
    }
    return Ok{};
}

/// Vertices that no run covers have no value.
Status finish(const GltfDocument& document, GltfColumn&& column, Animation& animation)
{
    if (column.covered < animation.vertex_count) {
        MESHREEL_CHECK(document.budget->take(animation.vertex_count * 4ull, document.json().member("meshes")));
        column.attribute.indices.assign(animation.vertex_count, gltf_none);
        std::uint32_t value = 0;
        for (const auto& [first, count] : column.runs)
            for (std::uint32_t v = 0; v < count; ++v) column.attribute.indices[first + v] = value++;
    }
    animation.appearance.attributes.push_back(std::move(column.attribute));
    return Ok{};
}

/// Adds the triangles of node after node.
struct Gatherer {
    const GltfSource& source;
    Animation& animation;
    std::vector<std::uint32_t> materials, groups; ///< one a triangle
    std::map<std::string, std::size_t> nodes;     ///< how often each node name came up

    /// The triangles of a node, in the order of its mesh's primitives.
    Status add(const GltfShown& shown, bool mirrored);
};

Status Gatherer::add(const GltfShown& shown, bool mirrored)
{
    const GltfNode& node = source.scene.nodes[shown.node];
    const GltfMesh& mesh = source.body.meshes[node.mesh];
    const std::size_t instance = ++nodes[node.name];
    for (const GltfTriangles& primitive : mesh.primitives) {
        const std::uint64_t total = animation.triangles.size() + primitive.triangles.size();
        MESHREEL_CHECK(within(total, source.document.limits.max_triangles, "triangle_count"));
        MESHREEL_CHECK(
            source.document.budget->take(primitive.triangles.size() * 28, source.document.json().member("nodes")));
        const std::uint32_t first = source.body.parts[shown.parts[primitive.vertices]].first;
        for (const Triangle& t : primitive.triangles)
            animation.triangles.push_back({first + t[0], first + t[mirrored ? 2 : 1], first + t[mirrored ? 1 : 2]});
        materials.resize(total, primitive.material);
        groups.resize(total, static_cast<std::uint32_t>(animation.appearance.groups.size()));
        animation.appearance.groups.push_back(GltfGroup{node.name, instance, mesh.name, primitive.primitive}.name());
    }
    return Ok{};
}

Status read_all_triangles(const GltfSource& source, Animation& animation)
{
    const GltfPose rest = pose_at(source.scene, nullptr, 0);
    Gatherer gatherer{source, animation, {}, {}, {}};
    for (const GltfShown& shown : source.body.shown) {
        if (shown.parts.empty()) continue;
        const bool skinned = source.body.parts[shown.parts[0]].skinned;
        const bool mirrored = !skinned && rest.world[shown.node].determinant() < 0;
        if (mirrored && source.warn)
            source.warn(concat("nodes[", shown.node, "]: is mirrored; its triangles are turned round"));
        MESHREEL_CHECK(gatherer.add(shown, mirrored));
    }
    const bool any = std::any_of(gatherer.materials.begin(), gatherer.materials.end(),
                                 [](std::uint32_t m) { return m != gltf_none; });
    if (any) animation.appearance.attributes.push_back(triangle_numbers("material", gatherer.materials));
    animation.appearance.attributes.push_back(triangle_numbers("group", gatherer.groups));
    return Ok{};
}

} // namespace

Status read_gltf_appearance(const GltfSource& source, Animation& animation)
{
    GltfColumns columns;
    for (const GltfPart& part : source.body.parts)
        MESHREEL_CHECK(gather(source, source.body.sets[part.set], part.first, columns));
    for (GltfColumn& column : columns) MESHREEL_CHECK(finish(source.document, std::move(column), animation));
    MESHREEL_CHECK(read_all_triangles(source, animation));
    const Json materials = source.document.json().member("materials");
    for (std::size_t m = 0; m < materials.size(); ++m) {
        MESHREEL_TRY(std::string name, materials.element(m).member("name").text_or(concat("material_", m)));
        animation.appearance.materials.push_back(std::move(name));
    }
    return read_gltf_assets(source.document, animation.appearance, source.warn);
}

} // namespace meshreel::io
