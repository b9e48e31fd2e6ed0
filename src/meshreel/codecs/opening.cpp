/// What every reader of a file does before its first segment.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/opening.h"

#include "meshreel/base/text.h"

namespace meshreel::codecs {

namespace {

using container::Header;
using container::StreamReader;

Status check_base(const Header& header, const Animation* base)
{
    if (header.order != Order::base) return Ok{};
    if (base == nullptr)
        return Error{ErrorCode::usage, "was made with a base mesh, which must be given to decode it", "base", {}, {}};
    const bool same = base->vertex_count == header.vertex_count &&
                      container::fingerprint_of(base->vertex_count, base->triangles) == header.base_fingerprint;
    if (same) return Ok{};
    return Error{ErrorCode::usage, "the base mesh given is not the one the file was made with", "base", {}, {}};
}

} // namespace

Result<connectivity::Topology> read_topology(const StreamReader& file, const Header& header, const Animation* base)
{
    MESHREEL_CHECK(check_base(header, base));
    const container::Chunk* chunk = file.find(container::type::conn);
    if (chunk == nullptr) return bad_input("the file has no such chunk", "CONN");
    const std::span<const Triangle> base_triangles = base == nullptr ? std::span<const Triangle>() : base->triangles;
    Result<connectivity::Topology> topology = connectivity::decode(chunk->payload, base_triangles, file.limits());
    if (!topology.ok()) {
        Error error = std::move(topology).error();
        error.field = error.field.empty() ? "CONN" : "CONN." + error.field;
        error.place = at_byte(chunk->offset + (error.place ? error.place->number : 0));
        return error;
    }
    if (topology->vertex_count != header.vertex_count || topology->surface.vertex_count != header.coded_vertex_count ||
        topology->triangles.size() != header.triangle_count)
        return bad_input("holds other counts than the header", "CONN", at_byte(chunk->offset));
    return topology;
}

Result<const Codec*> codec_of(const Header& header)
{
    const Codec* codec = find(header.codec);
    if (codec == nullptr) return unsupported(concat("there is no codec \"", header.codec, "\""), "HEAD.codec");
    return codec;
}

} // namespace meshreel::codecs
