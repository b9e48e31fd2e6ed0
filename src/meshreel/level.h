/// A level of detail of a file: which vertices it keeps, and the triangles between them.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/container/package.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

/// V' vertices and T' triangles, as they are decoded.
struct Level {
    std::vector<std::uint32_t> wanted;      ///< [V'] the surface vertex of each
    std::vector<std::uint32_t> vertex_of;   ///< [V'] its number at level 0, rising
    std::vector<Triangle> triangles;        ///< [T'] over 0 .. V'-1
    std::vector<std::uint32_t> triangle_of; ///< [T'] the triangle of level 0 that each came from, rising
    std::vector<std::uint32_t> corner_of;   ///< [3T'] the corner of level 0 whose values each has
};

/// Refuses a level of a codec that has none. @fails usage.
Status check_level(const codecs::Codec& codec, std::uint32_t level);

/// What a level is made from: the file's surface, and what it looks like.
struct LevelInput {
    const connectivity::Topology& topology;
    const Appearance& appearance;
};

/// A level of a file whose first segment this is. Where vertices are welded along seams, a triangle's corner is at the
/// kept one of them on the triangle's own side. @fails usage: no such level; as the codec does.
Result<Level> level_of(const codecs::Codec& codec, const codecs::Coded& first_segment, const LevelInput& input,
                       std::uint32_t level);

/// Bytes of a file that each of its levels takes, finest first: of each segment the beginning that the level needs, and
/// everything besides. One entry for a codec without levels. @fails as the codec does.
Result<std::vector<std::uint64_t>> level_bytes(const container::StreamReader& file, const container::Header& header,
                                               const codecs::Codec& codec);

/// What is left of an appearance: values of vertices and triangles stay with those that they belong to; a corner has those
/// of a corner at the same vertex in the chart (mesh/charts.h) of the triangle that its own came from, or, where the vertex is outside
/// that chart, of that triangle's corner, which is near.
Appearance appearance_of(const Level& level, const Appearance& appearance);

} // namespace meshreel
