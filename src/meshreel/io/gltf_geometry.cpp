/// Reads glTF meshes: vertices, morph targets, skin weights, triangles.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_geometry.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

/// Vertex numbers in drawing order: the indices, or 0, 1, 2, ...
Result<std::vector<std::uint32_t>> corner_list(const GltfDocument& document, const Json& primitive,
                                               std::uint32_t vertex_count)
{
    const Json field = primitive.member("indices");
    std::vector<std::uint32_t> corners;
    if (!field) {
        MESHREEL_CHECK(document.budget->take(vertex_count * 4ull, primitive));
        corners.resize(vertex_count);
        for (std::uint32_t v = 0; v < vertex_count; ++v) corners[v] = v;
        return corners;
    }
    MESHREEL_TRY(const Accessor found, accessor(document, field));
    MESHREEL_TRY(corners, integers(found, 1));
    for (std::size_t c = 0; c < corners.size(); ++c)
        if (corners[c] >= vertex_count)
            return found.where.wrong(
                concat("index ", c, " is ", corners[c], ", beyond the ", vertex_count, " vertices"));
    return corners;
}

/// @source glTF 2.0, 3.7.2.1
std::vector<Triangle> triangles_of(const std::vector<std::uint32_t>& corners, std::uint64_t mode)
{
    std::vector<Triangle> triangles;
    if (mode == 4)
        for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
            triangles.push_back({corners[c], corners[c + 1], corners[c + 2]});
    if (mode == 5)
        for (std::size_t c = 0; c + 2 < corners.size(); ++c)
            triangles.push_back({corners[c], corners[c + 1 + c % 2], corners[c + 2 - c % 2]});
    if (mode == 6)
        for (std::size_t c = 1; c + 1 < corners.size(); ++c)
            triangles.push_back({corners[c], corners[c + 1], corners[0]});
    return triangles;
}

Result<std::vector<Triangle>> read_triangles(const GltfDocument& document, const Json& primitive,
                                             std::uint32_t vertex_count)
{
    MESHREEL_TRY(const std::uint64_t mode, primitive.member("mode").integer_or(4, 7));
    MESHREEL_TRY(const std::vector<std::uint32_t> corners, corner_list(document, primitive, vertex_count));
    if (mode == 4 && corners.size() % 3 != 0)
        return primitive.member("indices").wrong(concat(corners.size(), " corners are no whole number of triangles"));
    const std::uint64_t count = mode == 4 ? corners.size() / 3 : corners.size() < 3 ? 0 : corners.size() - 2;
    MESHREEL_CHECK(within(count, document.limits.max_triangles, primitive.path));
    MESHREEL_CHECK(document.budget->take(count * sizeof(Triangle), primitive));
    return triangles_of(corners, mode);
}

/// One JOINTS_n and WEIGHTS_n pair, appended to each vertex's influences.
Status read_influences(const GltfDocument& document, GltfVertices& vertices, std::size_t set)
{
    const std::string joints_name = concat("JOINTS_", set), weights_name = concat("WEIGHTS_", set);
    const Json attributes = vertices.primitive.member("attributes");
    MESHREEL_TRY(const Accessor joints, accessor(document, attributes.member(joints_name.c_str())));
    MESHREEL_TRY(const Accessor weights, accessor(document, attributes.member(weights_name.c_str())));
    if (joints.count != vertices.count || weights.count != vertices.count)
        return attributes.wrong(concat(joints_name, " and ", weights_name, " disagree with POSITION in their count"));
    MESHREEL_TRY(const std::vector<std::uint32_t> joint_table, integers(joints, 4));
    MESHREEL_TRY(const Numbers weight_table, numbers(weights, 4));
    for (std::size_t v = 0; v < vertices.count; ++v)
        for (std::size_t i = 0; i < 4; ++i) {
            vertices.joints[v * vertices.influences + set * 4 + i] = joint_table[v * 4 + i];
            vertices.weights[v * vertices.influences + set * 4 + i] = weight_table(v, i);
        }
    return Ok{};
}

/// Scales each vertex's weights to a sum of 1, which files keep only up to rounding.
Status unit_sums(GltfVertices& vertices)
{
    for (std::size_t v = 0; v < vertices.count; ++v) {
        const std::span<double> weights(vertices.weights.data() + v * vertices.influences, vertices.influences);
        double sum = 0;
        for (double weight : weights) {
            if (weight < 0)
                return vertices.primitive.member("attributes").wrong(concat("vertex ", v, " has a negative weight"));
            sum += weight;
        }
        if (sum > 0)
            for (double& weight : weights) weight /= sum;
    }
    return Ok{};
}

Status read_skin_weights(const GltfDocument& document, GltfVertices& vertices)
{
    const Json attributes = vertices.primitive.member("attributes");
    std::size_t sets = 0;
    while (attributes.member(concat("JOINTS_", sets).c_str())) ++sets;
    vertices.influences = sets * 4;
    MESHREEL_CHECK(document.budget->take(vertices.count * vertices.influences * 12ull, attributes));
    vertices.joints.resize(vertices.count * vertices.influences);
    vertices.weights.resize(vertices.count * vertices.influences);
    for (std::size_t set = 0; set < sets; ++set) MESHREEL_CHECK(read_influences(document, vertices, set));
    return unit_sums(vertices);
}

Result<GltfVertices> read_vertices(const GltfDocument& document, const Json& primitive)
{
    GltfVertices vertices;
    vertices.primitive = primitive;
    MESHREEL_TRY(const Accessor positions, accessor(document, primitive.member("attributes").member("POSITION")));
    MESHREEL_CHECK(within(positions.count, std::min<std::uint64_t>(document.limits.max_vertices, gltf_none - 1),
                          positions.where.path));
    vertices.count = static_cast<std::uint32_t>(positions.count);
    MESHREEL_TRY(vertices.rest, numbers(positions, 3));
    const Json targets = primitive.member("targets");
    vertices.targets.resize(targets.size());
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const Json field = targets.element(t).member("POSITION");
        if (!field) continue;
        MESHREEL_TRY(const Accessor offsets, accessor(document, field));
        if (offsets.count != positions.count)
            return field.wrong(concat(offsets.count, " offsets for ", positions.count, " vertices"));
        if (offsets.data == nullptr && offsets.sparse_count == 0) continue;
        MESHREEL_TRY(vertices.targets[t], numbers(offsets, 3));
    }
    MESHREEL_CHECK(read_skin_weights(document, vertices));
    return vertices;
}

/// The number of a primitive's vertex set: that of an earlier primitive with the same accessors, or a new one.
Result<std::uint32_t> vertex_set(const GltfDocument& document, const Json& primitive, GltfVertexSets& vertices)
{
    std::string key;
    for (const char* part : {"attributes", "targets"}) {
        const Json field = primitive.member(part);
        if (field) key += field.value->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        key += '\n';
    }
    const auto [place, fresh] = vertices.numbers.try_emplace(key, static_cast<std::uint32_t>(vertices.sets.size()));
    if (fresh) {
        MESHREEL_CHECK(document.budget->take(key.size() + sizeof(GltfVertices), primitive));
        MESHREEL_TRY(GltfVertices set, read_vertices(document, primitive));
        vertices.sets.push_back(std::move(set));
    }
    return place->second;
}

/// Its place among those of a mesh.
std::size_t place_in(std::vector<std::uint32_t>& sets, std::uint32_t set)
{
    const auto found = std::find(sets.begin(), sets.end(), set);
    if (found == sets.end()) {
        sets.push_back(set);
        return sets.size() - 1;
    }
    return static_cast<std::size_t>(found - sets.begin());
}

} // namespace

Result<GltfMesh> read_gltf_mesh(const GltfDocument& document, std::size_t number, GltfVertexSets& vertices,
                                const std::function<void(std::string)>& warn)
{
    const Json json = document.item("meshes", number), primitives = json.member("primitives");
    GltfMesh mesh;
    MESHREEL_TRY(mesh.name, json.member("name").text_or(""));
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const Json primitive = primitives.element(p);
        MESHREEL_TRY(const std::uint64_t mode, primitive.member("mode").integer_or(4, 7));
        if (mode < 4) {
            if (warn)
                warn(concat(primitive.path, ": is made of ", mode == 0 ? "points" : "lines", ", which are left out"));
            continue;
        }
        GltfTriangles part;
        part.primitive = p;
        MESHREEL_TRY(const std::uint32_t set, vertex_set(document, primitive, vertices));
        part.vertices = place_in(mesh.sets, set);
        if (primitive.member("material")) {
            MESHREEL_TRY(const std::uint64_t material,
                         primitive.member("material").integer(document.count("materials")));
            part.material = static_cast<std::uint32_t>(material);
        }
        MESHREEL_TRY(part.triangles, read_triangles(document, primitive, vertices.sets[set].count));
        mesh.primitives.push_back(std::move(part));
    }
    return mesh;
}

} // namespace meshreel::io
