/// A level of detail of a file: which vertices it keeps, and the triangles between them.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/container/package.h"
#include "meshreel/mesh/animation.h"
#include "meshreel/mesh/surface_part.h"

namespace meshreel {

/// V' vertices and T' triangles, as they are decoded; the whole is level 0.
using Level = SurfacePart;

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

} // namespace meshreel
