/// Chunks of an animation in their order, each checked against the mesh it belongs to.
// SPDX-License-Identifier: MIT
#include "meshreel/container/package.h"

#include "meshreel/base/text.h"

namespace meshreel::container {

namespace {

/// The same result, its error pointing at the chunk it came from.
template <class T>
Result<T> in_chunk(Result<T> result, const Chunk& chunk)
{
    if (result.ok()) return result;
    Error error = std::move(result).error();
    if (!error.place) error.place = at_byte(chunk.offset);
    if (error.field.rfind(name_of(chunk.type), 0) != 0) error.field = joined(name_of(chunk.type), ".", error.field);
    return error;
}

Status add_names(StreamWriter& file, Tag type, const std::vector<std::string>& names)
{
    return names.empty() ? Status(Ok{}) : file.add(type, NamesChunk{names});
}

Result<std::vector<std::string>> read_names(const StreamReader& file, Tag type)
{
    if (file.find(type) == nullptr) return std::vector<std::string>{};
    MESHREEL_TRY(NamesChunk chunk, file.read<NamesChunk>(type));
    return std::move(chunk.names);
}

Result<Asset> read_asset(const StreamReader& file, const Chunk& chunk, Budget& budget)
{
    MESHREEL_TRY(AssetChunk packed, read_fields<AssetChunk>(chunk.source(), file.limits()));
    MESHREEL_TRY(Bytes bytes, in_chunk(unsqueeze(packed.bytes, budget), chunk));
    return Asset{std::move(packed.name), std::move(packed.mime_type), std::move(bytes)};
}

Result<Attribute> read_attribute(const StreamReader& file, const Chunk& chunk, const MeshShape& mesh, Budget& budget)
{
    MESHREEL_TRY(const AttributeChunk packed, read_fields<AttributeChunk>(chunk.source(), file.limits()));
    return in_chunk(unpack_attribute(packed, mesh, budget), chunk);
}

} // namespace

Status add_head(StreamWriter& file, const Header& header, const std::vector<double>& times_s, const Metadata& meta)
{
    MESHREEL_CHECK(file.add(type::head, header));
    MESHREEL_CHECK(file.add(type::time, pack_times(times_s, meta.fps)));
    return file.add(type::meta, MetaChunk{meta});
}

Status add_appearance(StreamWriter& file, const Appearance& appearance, const MeshShape& mesh)
{
    MESHREEL_CHECK(add_names(file, type::matl, appearance.materials));
    MESHREEL_CHECK(add_names(file, type::grup, appearance.groups));
    for (const Attribute& attribute : appearance.attributes)
        MESHREEL_CHECK(file.add(type::attr, pack_attribute(attribute, mesh)));
    for (const Asset& asset : appearance.assets)
        MESHREEL_CHECK(file.add(type::aset, AssetChunk{asset.name, asset.mime_type, squeeze(asset.bytes)}));
    return Ok{};
}

Result<Header> read_header(const StreamReader& file)
{
    MESHREEL_TRY(const Header header, file.read<Header>(type::head));
    MESHREEL_CHECK(
        in_chunk(within(file.limits(), header.vertex_count, header.triangle_count, 1), *file.find(type::head)));
    return header;
}

Result<std::vector<double>> read_times(const StreamReader& file, const Header& header, Budget& budget)
{
    MESHREEL_TRY(const TimeChunk chunk, file.read<TimeChunk>(type::time));
    return in_chunk(unpack_times(chunk, header.frame_count, budget), *file.find(type::time));
}

Result<Metadata> read_metadata(const StreamReader& file)
{
    if (file.find(type::meta) == nullptr) return Metadata{};
    MESHREEL_TRY(MetaChunk chunk, file.read<MetaChunk>(type::meta));
    return std::move(chunk.meta);
}

Result<Appearance> read_appearance(const StreamReader& file, const MeshShape& mesh, Budget& budget)
{
    Appearance appearance;
    MESHREEL_TRY(appearance.materials, read_names(file, type::matl));
    MESHREEL_TRY(appearance.groups, read_names(file, type::grup));
    for (const Chunk& chunk : file.chunks()) {
        if (chunk.type == type::attr) {
            MESHREEL_TRY(Attribute attribute, read_attribute(file, chunk, mesh, budget));
            appearance.attributes.push_back(std::move(attribute));
        }
        if (chunk.type == type::aset) {
            MESHREEL_TRY(Asset asset, read_asset(file, chunk, budget));
            appearance.assets.push_back(std::move(asset));
        }
    }
    return appearance;
}

Result<Segment> read_segment(const Chunk& chunk, const DecodeLimits& limits)
{
    MESHREEL_TRY(Segment segment, read_fields<Segment>(chunk.source(), limits));
    segment.payload_offset = chunk.offset + (chunk.payload.size() - segment.payload.size());
    return segment;
}

Result<std::vector<Segment>> read_segments(const StreamReader& file, const Header& header)
{
    std::vector<Segment> segments;
    std::uint64_t next = 0;
    for (const Chunk& chunk : file.all(type::segm)) {
        MESHREEL_TRY(const Segment segment, read_segment(chunk, file.limits()));
        if (segment.first_frame != next || segment.frame_count > header.frame_count - next)
            return bad_input(concat("frames ", segment.first_frame, " and ", segment.frame_count - 1ull,
                                    " more, but frame ", next, " of ", header.frame_count, " is next"),
                             "SEGM.first_frame", at_byte(chunk.offset));
        next += segment.frame_count;
        segments.push_back(segment);
    }
    if (next == header.frame_count) return segments;
    return bad_input(concat("the segments end at frame ", next, " of ", header.frame_count), "SEGM.frame_count");
}

} // namespace meshreel::container
