/// Reads a glTF scene's nodes and skins.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_scene.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

/// From glTF's 16 numbers, column after column.
Result<Affine> affine_from(std::span<const double> columns, const Json& field)
{
    const double off = std::abs(columns[3]) + std::abs(columns[7]) + std::abs(columns[11]) + std::abs(columns[15] - 1);
    if (!(off < 1e-4)) return field.wrong("is no affine matrix: its last row is not 0 0 0 1");
    Affine affine;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) affine.m[row * 4 + column] = columns[column * 4 + row];
    return affine;
}

Result<std::vector<double>> number_list(const Json& field)
{
    std::vector<double> list(field.size());
    MESHREEL_CHECK(field.numbers(list));
    return list;
}

Result<std::uint32_t> reference(const Json& field, std::uint64_t count)
{
    if (!field) return gltf_none;
    MESHREEL_TRY(const std::uint64_t number, field.integer(count));
    return static_cast<std::uint32_t>(number);
}

Result<GltfNode> read_node(const GltfDocument& document, std::size_t number)
{
    const Json json = document.item("nodes", number);
    GltfNode node;
    MESHREEL_TRY(node.name, json.member("name").text_or(""));
    MESHREEL_TRY(node.mesh, reference(json.member("mesh"), document.count("meshes")));
    MESHREEL_TRY(node.skin, reference(json.member("skin"), document.count("skins")));
    MESHREEL_CHECK(json.member("translation").numbers(node.trs.translation));
    MESHREEL_CHECK(json.member("rotation").numbers(node.trs.rotation));
    MESHREEL_CHECK(json.member("scale").numbers(node.trs.scale));
    const Json matrix = json.member("matrix");
    if (matrix) {
        std::array<double, 16> columns{};
        MESHREEL_CHECK(matrix.numbers(columns));
        MESHREEL_TRY(node.matrix, affine_from(columns, matrix));
        node.has_matrix = true;
    }
    MESHREEL_TRY(node.weights, number_list(json.member("weights")));
    if (node.weights.empty() && node.mesh != gltf_none) {
        MESHREEL_TRY(node.weights, number_list(document.item("meshes", node.mesh).member("weights")));
    }
    const std::size_t bytes = sizeof node + node.weights.size() * sizeof(double);
    MESHREEL_CHECK(document.budget->take(3 * bytes, json)); // with its pose, and what decides that
    return node;
}

Status read_hierarchy(const GltfDocument& document, GltfScene& scene)
{
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Json children = document.item("nodes", n).member("children");
        for (std::size_t c = 0; c < children.size(); ++c) {
            MESHREEL_TRY(const std::uint64_t child, children.element(c).integer(scene.nodes.size()));
            if (scene.nodes[child].parent != gltf_none || child == n)
                return children.element(c).wrong(concat("node ", child, " has two parents"));
            scene.nodes[child].parent = static_cast<std::uint32_t>(n);
        }
    }
    std::vector<std::vector<std::uint32_t>> children(scene.nodes.size());
    for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].parent == gltf_none)
            scene.order.push_back(n);
        else
            children[scene.nodes[n].parent].push_back(n);
    }
    for (std::size_t i = 0; i < scene.order.size(); ++i)
        for (std::uint32_t child : children[scene.order[i]]) scene.order.push_back(child);
    if (scene.order.size() != scene.nodes.size()) return bad_input("the hierarchy has a cycle", "nodes");
    return Ok{};
}

/// The default scene, else the first, else every node.
Status mark_visible(const GltfDocument& document, GltfScene& scene)
{
    const std::uint64_t scenes = document.count("scenes");
    MESHREEL_TRY(const std::uint64_t shown,
                 document.json().member("scene").integer_or(0, std::max<std::uint64_t>(scenes, 1)));
    if (scenes == 0)
        for (GltfNode& node : scene.nodes) node.visible = true;
    const Json roots = document.item("scenes", shown).member("nodes");
    for (std::size_t r = 0; r < roots.size(); ++r) {
        MESHREEL_TRY(const std::uint64_t root, roots.element(r).integer(scene.nodes.size()));
        scene.nodes[root].visible = true;
    }
    for (std::uint32_t n : scene.order)
        if (scene.nodes[n].parent != gltf_none && scene.nodes[scene.nodes[n].parent].visible)
            scene.nodes[n].visible = true;
    return Ok{};
}

Result<GltfSkin> read_skin(const GltfDocument& document, std::size_t number)
{
    const Json json = document.item("skins", number), joints = json.member("joints");
    GltfSkin skin;
    if (joints.size() == 0) return joints.wrong("names no joint");
    for (std::size_t j = 0; j < joints.size(); ++j) {
        MESHREEL_TRY(const std::uint64_t joint, joints.element(j).integer(document.count("nodes")));
        skin.joints.push_back(static_cast<std::uint32_t>(joint));
    }
    skin.inverse_bind.resize(skin.joints.size());
    const Json matrices = json.member("inverseBindMatrices");
    if (!matrices) return skin;
    MESHREEL_TRY(const Accessor found, accessor(document, matrices));
    if (found.count < skin.joints.size())
        return matrices.wrong(concat(found.count, " matrices for ", skin.joints.size(), " joints"));
    MESHREEL_TRY(const Numbers table, numbers(found, 16));
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        std::array<double, 16> columns{};
        for (std::size_t i = 0; i < 16; ++i) columns[i] = table(j, i);
        MESHREEL_TRY(skin.inverse_bind[j], affine_from(columns, matrices));
    }
    return skin;
}

} // namespace

std::array<double, 3> Affine::operator()(const std::array<double, 3>& p) const
{
    return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
            m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]};
}

Affine operator*(const Affine& first, const Affine& second)
{
    Affine product;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            double sum = column == 3 ? first.m[row * 4 + 3] : 0.0;
            for (std::size_t k = 0; k < 3; ++k) sum += first.m[row * 4 + k] * second.m[k * 4 + column];
            product.m[row * 4 + column] = sum;
        }
    return product;
}

double Affine::determinant() const
{
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
           m[2] * (m[4] * m[9] - m[5] * m[8]);
}

Affine Trs::matrix() const
{
    const auto& [x, y, z, w] = rotation;
    const double square = x * x + y * y + z * z + w * w;
    const double s = square > 0 ? 2 / square : 0; // normalises on the way
    Affine affine;
    affine.m = {(1 - s * (y * y + z * z)) * scale[0], s * (x * y - z * w) * scale[1],
                s * (x * z + y * w) * scale[2],       translation[0],
                s * (x * y + z * w) * scale[0],       (1 - s * (x * x + z * z)) * scale[1],
                s * (y * z - x * w) * scale[2],       translation[1],
                s * (x * z - y * w) * scale[0],       s * (y * z + x * w) * scale[1],
                (1 - s * (x * x + y * y)) * scale[2], translation[2]};
    return affine;
}

Result<GltfScene> read_gltf_scene(const GltfDocument& document)
{
    GltfScene scene;
    for (std::size_t n = 0; n < document.count("nodes"); ++n) {
        MESHREEL_TRY(GltfNode node, read_node(document, n));
        scene.nodes.push_back(std::move(node));
    }
    MESHREEL_CHECK(read_hierarchy(document, scene));
    MESHREEL_CHECK(mark_visible(document, scene));
    for (std::size_t s = 0; s < document.count("skins"); ++s) {
        MESHREEL_TRY(GltfSkin skin, read_skin(document, s));
        scene.skins.push_back(std::move(skin));
    }
    return scene;
}

} // namespace meshreel::io
