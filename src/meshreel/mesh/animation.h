/// The animation: one triangle list, V vertices, F frames of positions, and what it looks like.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel {

using Triangle = std::array<std::uint32_t, 3>; ///< three vertex indices, in the file's order

/// What an attribute's values belong to.
enum class Domain : std::uint8_t { vertex, corner, triangle };

/// The type of one number of an attribute.
enum class Scalar : std::uint8_t { f32, u8, u16, u32, i8, i16 };

constexpr std::size_t scalar_size(Scalar type)
{
    return type == Scalar::u8 || type == Scalar::i8 ? 1 : type == Scalar::u16 || type == Scalar::i16 ? 2 : 4;
}

/// One table of values carried beside the positions, bit for bit: a UV set, normals, colours, material numbers.
struct Attribute {
    /// "uv0", "uv1", ...; "normal"; "tangent"; "color0", ...; "material" and "group" (domain triangle, u32, an index
    /// into Appearance::materials / groups, or 0xffffffff: none); any other name is carried too.
    std::string name;
    Domain domain = Domain::vertex;
    Scalar type = Scalar::f32;
    std::uint8_t components = 1;        ///< numbers a value, 1 .. 16
    bool normalized = false;            ///< integers stand for [0, 1] or [-1, 1]
    Bytes values;                       ///< little-endian, value after value
    std::vector<std::uint32_t> indices; ///< one a vertex, corner or triangle, into values; empty: value i belongs to i.
                                        ///< 0xffffffff: this element has no value

    std::size_t value_count() const { return values.size() / (scalar_size(type) * components); }
};

/// A file that travels along unread: a texture image, a block of glTF JSON with the materials.
struct Asset {
    std::string name;
    std::string mime_type; ///< "image/png", "model/gltf+json;materials", ...
    Bytes bytes;
};

/// What the surface looks like. Never changed by a codec.
struct Appearance {
    std::vector<Attribute> attributes;
    std::vector<std::string> materials; ///< names, indexed by the attribute "material"
    std::vector<std::string> groups;    ///< names, indexed by the attribute "group"
    std::vector<Asset> assets;

    const Attribute* find(const std::string& name) const;
};

enum class Axis : std::uint8_t { unknown, x, y, z };

/// What is known about the animation as a whole. Nothing here is guessed: 0 or unknown where the file does not say.
struct Metadata {
    std::string name;
    bool loop = false; ///< the last frame is followed by the first
    Axis up = Axis::unknown;
    double metres_per_unit = 0.0; ///< 0: unknown
    double fps = 0.0;             ///< nominal frames a second; 0: unknown, the times stand for themselves
};

/// A dynamic mesh: constant connectivity, moving vertices.
struct Animation {
    std::uint32_t vertex_count = 0;  ///< V
    std::vector<Triangle> triangles; ///< [T], vertex indices 0 .. V-1; any of the shapes of degenerate or non-manifold
    std::vector<float> positions;    ///< [F x V x 3], model units, frame after frame
    std::vector<double> times_s;     ///< [F], seconds, strictly increasing
    Appearance appearance;
    Metadata meta;

    std::size_t frame_count() const { return times_s.size(); }
    /// Positions of one frame, [V x 3].
    std::span<const float> frame(std::size_t f) const
    {
        return {positions.data() + f * vertex_count * 3, vertex_count * 3ul};
    }
    std::span<float> frame(std::size_t f) { return {positions.data() + f * vertex_count * 3, vertex_count * 3ul}; }
};

/// F times from `start_s`, 1 / fps apart. fps > 0.
std::vector<double> uniform_times(std::size_t frame_count, double fps, double start_s = 0.0);

/// Names what is wrong with an animation and where: sizes that disagree, an index out of range, a NaN or infinity by
/// frame and vertex, times that do not increase, an attribute whose table does not fit, a "material" or "group" number
/// without a name. Degenerate, duplicated and non-manifold triangles are valid. @fails bad_input. @cost O(F V + T).
Status validate(const Animation& animation);

/// The same of all but the positions, which may be missing. @cost O(V + T + F).
Status validate_still(const Animation& animation);
/// Finds a NaN or infinity in frames [N x 3V] of which the first has the number `first`. @fails bad_input.
Status validate_frames(std::size_t first, MatrixView<const float> frames);

/// Length of the diagonal of the bounding box of the first frame, model units. @source thesis 2.1
double body_diagonal(const Animation& animation);
/// The same of that frame, [V x 3].
double body_diagonal(std::span<const float> first_frame);

} // namespace meshreel
