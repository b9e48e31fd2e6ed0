/// Kept vertices from the codec, triangles from the surface, and what belongs to them.
// SPDX-License-Identifier: MIT
#include "meshreel/level.h"

#include "meshreel/base/text.h"

namespace meshreel {

namespace {

Error no_level(Sentence message)
{
    return {ErrorCode::usage, std::move(message), "level", {}, {}};
}

} // namespace

Status check_level(const codecs::Codec& codec, std::uint32_t level)
{
    if (level == 0 || codec.detail != nullptr) return Ok{};
    return no_level(concat("the codec ", codec.name, " has no levels of detail"));
}

Result<Level> level_of(const codecs::Codec& codec, const codecs::Coded& first_segment, const LevelInput& input,
                       std::uint32_t level)
{
    const connectivity::Topology& topology = input.topology;
    MESHREEL_TRY(const codecs::Detail detail, codec.detail(first_segment));
    if (level >= detail.counts.size())
        return no_level(concat("there is no level ", level, "; the coarsest is ", detail.counts.size() - 1));
    return surface_part({topology.surface.vertex_count, topology.triangles, topology.surface_of}, input.appearance,
                        detail.places.view(), detail.kept(level));
}

} // namespace meshreel
