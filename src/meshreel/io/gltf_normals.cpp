/// Turns normals and tangents with the pose that a glTF scene is baked in.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>

#include "meshreel/io/attributes.h"
#include "meshreel/io/gltf_bake.h"

namespace meshreel::io {

namespace {

using Vector = std::array<double, 3>;

/// A positive multiple of the identity, within what a float32 shows.
bool keeps_directions(const Affine& pose)
{
    const double scale = pose.m[0];
    double off = 0;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            off = std::max(off, std::abs(pose.m[row * 4 + column] - (row == column ? scale : 0.0)));
    return scale > 0 && off <= 1e-6 * scale;
}

/// The linear part, or, for normals, the matrix of its cofactors: its inverse transpose times its determinant.
Vector turned(const Affine& pose, const Vector& v, bool normal)
{
    const auto& m = pose.m;
    if (!normal)
        return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[4] * v[0] + m[5] * v[1] + m[6] * v[2],
                m[8] * v[0] + m[9] * v[1] + m[10] * v[2]};
    const auto cofactor = [&](std::size_t row, std::size_t column) {
        const std::size_t r1 = (row + 1) % 3 * 4, r2 = (row + 2) % 3 * 4, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
        return m[r1 + c1] * m[r2 + c2] - m[r1 + c2] * m[r2 + c1];
    };
    Vector out{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) out[row] += cofactor(row, column) * v[column];
    return out;
}

/// The pose of each vertex; those without any keep the identity.
template <class Visit>
void for_each_pose(const GltfScene& scene, const GltfBody& body, const GltfPose& pose, const Visit& visit)
{
    for (const GltfPart& part : body.parts) {
        const GltfVertices& vertices = body.sets[part.set];
        Affine matrix = pose.world[part.node];
        for (std::size_t v = 0; v < vertices.count; ++v) {
            if (part.skinned && !blend(vertices, v, pose.joints[scene.nodes[part.node].skin], matrix))
                matrix = Affine();
            visit(part.first + v, matrix);
        }
    }
}

/// Any number type to float32, values unchanged.
void to_floats(Attribute& attribute)
{
    if (attribute.type == Scalar::f32) return;
    Bytes values;
    for (std::size_t i = 0; i < attribute.value_count(); ++i)
        for (std::size_t c = 0; c < attribute.components; ++c) append_little(values, attribute_float(attribute, i, c));
    attribute.values = std::move(values);
    attribute.type = Scalar::f32;
    attribute.normalized = false;
}

void turn_value(Attribute& attribute, std::size_t place, const Affine& pose, bool normal)
{
    std::array<float, 4> value{};
    std::uint8_t* const bytes = &attribute.values[place * attribute.components * 4];
    std::memcpy(value.data(), bytes, attribute.components * 4ul);
    const double sign = pose.determinant() < 0 ? -1 : 1;
    Vector out = turned(pose, {value[0], value[1], value[2]}, normal);
    const double length = std::sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    if (!(length > 0) || !std::isfinite(length)) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
        value[axis] = static_cast<float>((normal ? sign : 1.0) * out[axis] / length);
    value[3] *= static_cast<float>(sign);
    std::memcpy(bytes, value.data(), attribute.components * 4ul);
}

} // namespace

void turn_normals(const GltfScene& scene, const GltfBody& body, const GltfPose& pose, Animation& animation)
{
    bool any = false;
    for_each_pose(scene, body, pose,
                  [&](std::size_t, const Affine& matrix) { any = any || !keeps_directions(matrix); });
    if (!any) return;
    for (Attribute& attribute : animation.appearance.attributes) {
        const std::string name = attribute.name.substr(0, attribute.name.find('|'));
        const bool normal = name == "normal";
        if ((!normal || attribute.components != 3) && (name != "tangent" || attribute.components != 4)) continue;
        to_floats(attribute);
        for_each_pose(scene, body, pose, [&](std::size_t v, const Affine& matrix) {
            const std::size_t place = attribute.indices.empty() ? v : attribute.indices[v];
            if (place != no_value && !keeps_directions(matrix)) turn_value(attribute, place, matrix, normal);
        });
    }
}

} // namespace meshreel::io
