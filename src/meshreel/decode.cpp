/// The way out of a file: from any bytes to an animation, or to what they say of themselves.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/memory.h"
#include "meshreel/base/text.h"
#include "meshreel/codecs/opening.h"
#include "meshreel/container/explain.h"
#include "meshreel/container/package.h"
#include "meshreel/level.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/meshreel.h"
#include "meshreel/shown_frames.h"

namespace meshreel {

namespace {

using container::Header;
using container::StreamReader;

/// Gives each of the V vertices the trajectory of its surface vertex.
std::vector<float> spread(const Matrix<float>& frames, std::span<const std::uint32_t> surface_of)
{
    std::vector<float> positions(frames.rows * surface_of.size() * 3);
    const std::size_t width = 3 * surface_of.size();
    for (std::size_t f = 0; f < frames.rows; ++f)
        reorder_frame(frames.row(f), surface_of, std::span(positions).subspan(f * width, width));
    return positions;
}

/// A file whose parts lie ready.
struct Opening {
    const StreamReader& file;
    const Header& header;
    container::SegmentSource& segments;
    std::uint64_t file_bytes;
};

/// What all frames and triangles of a file take.
std::uint64_t decoded_bytes(const Header& header)
{
    constexpr std::uint64_t bytes_a_position = 12, bytes_a_triangle = 12;
    return bytes_a_position * header.vertex_count * header.frame_count + bytes_a_triangle * header.triangle_count;
}

/// How much of a payload a level needs. Levels are the first segment's: of others it may need everything.
Result<std::uint64_t> bytes_of_level(const codecs::Codec& codec, const container::Segment& beginning,
                                     const DecodeOptions& options)
{
    MESHREEL_TRY(const std::vector<std::uint64_t> bytes, codec.level_bytes(beginning.source(), options.limits));
    return bytes[beginning.first_frame == 0 ? std::min<std::size_t>(options.level, bytes.size() - 1) : 0];
}

/// The file's level that the options ask for.
Result<Level> level_asked_for(const Opening& reel, const codecs::Codec& codec, const LevelInput& input,
                              const DecodeOptions& options)
{
    MESHREEL_TRY(const container::Segment first, reel.segments.holding(0));
    return level_of(codec, {first.source(), input.topology.surface, first.frame_count, options.limits, options.threads},
                    input, options.level);
}

Result<Animation> unpacked(const Opening& reel, const DecodeOptions& options)
{
    const auto& [file, header, segments, file_bytes] = reel;
    Animation animation;
    animation.vertex_count = header.vertex_count;
    container::Budget times_budget(options.limits.max_memory);
    MESHREEL_TRY(const std::vector<double> times, container::read_times(file, header, times_budget));
    MESHREEL_TRY(animation.meta, container::read_metadata(file));
    const std::uint64_t vertices = header.vertex_count + std::uint64_t{header.coded_vertex_count};
    const std::uint64_t most = std::min(options.limits.max_frames, options.limits.max_memory / 12 / vertices);
    MESHREEL_TRY(ShownFrames shown, shown_frames(times, animation.meta, options, most));
    MESHREEL_CHECK(within(options.limits, vertices, header.triangle_count, shown.mixes.size()));
    MESHREEL_CHECK(within_expansion(options.limits, decoded_bytes(header), file_bytes));
    MESHREEL_TRY(const codecs::Codec* codec, codecs::codec_of(header));
    MESHREEL_CHECK(check_level(*codec, options.level));
    MESHREEL_TRY(connectivity::Topology topology, codecs::read_topology(file, header, options.base));
    container::Budget budget(options.limits.max_memory -
                             std::min(options.limits.max_memory, 12 * header.vertex_count * shown.mixes.size()));
    MESHREEL_TRY(animation.appearance,
                 container::read_appearance(file, {header.vertex_count, topology.triangles}, budget));
    std::optional<Level> level;
    if (options.level > 0) {
        MESHREEL_TRY(level, level_asked_for(reel, *codec, {topology, animation.appearance}, options));
    }
    MESHREEL_TRY(Matrix<float> frames,
                 pose_frames({*codec, segments, topology.surface, options, level ? &level->wanted : nullptr}, shown));
    animation.positions = level ? std::move(frames.values) : spread(frames, topology.surface_of);
    animation.triangles = std::move(level ? level->triangles : topology.triangles);
    animation.times_s = std::move(shown.times_s);
    animation.meta.fps = shown.fps;
    if (level) {
        animation.vertex_count = static_cast<std::uint32_t>(level->wanted.size());
        animation.appearance = appearance_of(*level, animation.appearance);
    }
    MESHREEL_CHECK(validate(animation));
    return animation;
}

/// For a level, the beginning of a file is enough.
Result<StreamReader> open_parts(ByteSource& reel, const DecodeOptions& options)
{
    Result<StreamReader> head = StreamReader::open_head(reel, options.limits);
    if (head.ok() || options.level == 0) return head;
    Result<StreamReader> beginning = StreamReader::open_beginning(reel, options.limits);
    return beginning.ok() ? std::move(beginning) : std::move(head);
}

/// The names of all that is carried beside the positions, without unpacking it.
Status read_names(const StreamReader& file, Info& info)
{
    for (const container::Chunk& chunk : file.all(container::type::attr)) {
        MESHREEL_TRY(auto attribute, container::read_fields<container::AttributeChunk>(chunk.source(), file.limits()));
        info.attributes.push_back(std::move(attribute.head.name));
    }
    for (const container::Chunk& chunk : file.all(container::type::aset)) {
        MESHREEL_TRY(auto asset, container::read_fields<container::AssetChunk>(chunk.source(), file.limits()));
        info.assets.push_back(std::move(asset.name));
    }
    for (const container::Chunk& chunk : file.chunks()) {
        if (chunk.type != container::type::matl && chunk.type != container::type::grup) continue;
        MESHREEL_TRY(auto names, container::read_fields<container::NamesChunk>(chunk.source(), file.limits()));
        (chunk.type == container::type::matl ? info.materials : info.groups) = std::move(names.names);
    }
    return Ok{};
}

} // namespace

Result<Animation> decode(ByteView reel, const DecodeOptions& options)
{
    return within_memory([&]() -> Result<Animation> {
        MESHREEL_TRY(const StreamReader file, StreamReader::open(reel, options.limits));
        MESHREEL_TRY(const Header header, container::read_header(file));
        MESHREEL_TRY(container::SegmentList segments, container::SegmentList::open(file, header));
        return unpacked({file, header, segments, reel.size()}, options);
    });
}

Result<Animation> decode(ByteSource& reel, const DecodeOptions& options)
{
    return within_memory([&]() -> Result<Animation> {
        MESHREEL_TRY(const StreamReader head, open_parts(reel, options));
        MESHREEL_TRY(const Header header, container::read_header(head));
        container::SegmentFetcher segments(reel, head, header);
        if (options.level > 0) {
            MESHREEL_TRY(const codecs::Codec* codec, codecs::codec_of(header));
            MESHREEL_CHECK(check_level(*codec, options.level));
            segments.fetch_only([codec, &options](const container::Segment& beginning) {
                return bytes_of_level(*codec, beginning, options);
            });
        }
        return unpacked({head, header, segments, reel.size()}, options);
    });
}

namespace {

/// What a reader should know before it decodes.
std::vector<std::string> warnings_of(const Header& header, std::uint64_t file_bytes, const DecodeLimits& limits)
{
    std::vector<std::string> warnings;
    const std::uint64_t bytes = decoded_bytes(header);
    if (bytes / Info::usual_expansion > file_bytes)
        warnings.push_back(concat("unpacks to ", bytes, " bytes, ", bytes / file_bytes, " times its size"));
    for (const Status& refused : {within(limits, header.vertex_count, header.triangle_count, header.frame_count),
                                  within_expansion(limits, bytes, file_bytes)})
        if (!refused.ok()) warnings.push_back(joined("will not be decoded: ", refused.error().message));
    return warnings;
}

Result<Info> look_at(ByteView reel, const DecodeLimits& limits)
{
    MESHREEL_TRY(const StreamReader file, StreamReader::open(reel, limits));
    MESHREEL_TRY(const Header header, container::read_header(file));
    container::Budget budget(limits.max_memory);
    MESHREEL_TRY(const std::vector<double> times, container::read_times(file, header, budget));
    Info info;
    info.codec = header.codec;
    info.encoder = header.encoder;
    info.version_major = file.preamble().major;
    info.version_minor = file.preamble().minor;
    info.vertices = header.vertex_count;
    info.coded_vertices = header.coded_vertex_count;
    info.triangles = header.triangle_count;
    info.frames = header.frame_count;
    info.order = header.order;
    info.decoded_bytes = decoded_bytes(header);
    info.warnings = warnings_of(header, reel.size(), limits);
    info.start_s = times.front();
    info.end_s = times.back();
    MESHREEL_TRY(info.meta, container::read_metadata(file));
    MESHREEL_CHECK(read_names(file, info));
    for (const container::Chunk& chunk : file.chunks())
        info.chunks.push_back({container::name_of(chunk.type), chunk.begin, chunk.end() - chunk.begin});
    if (const codecs::Codec* codec = codecs::find(header.codec)) {
        MESHREEL_TRY(info.level_bytes, level_bytes(file, header, *codec));
    }
    return info;
}

} // namespace

Result<Info> info(ByteView reel, const DecodeLimits& limits)
{
    return within_memory([&] { return look_at(reel, limits); });
}

Result<std::string> explain(ByteView reel, const DecodeLimits& limits)
{
    return within_memory([&]() -> Result<std::string> {
        MESHREEL_TRY(const StreamReader file, StreamReader::open(reel, limits));
        return container::explain(
            file,
            [&](const Header& header, container::Tag type, container::Source payload, std::string& lines) -> Status {
                if (type == container::type::conn)
                    return container::explain_fields<connectivity::PayloadFields>(payload, limits, lines);
                if (type != container::type::segm) return Ok{};
                MESHREEL_TRY(const codecs::Codec* codec, codecs::codec_of(header));
                return codec->explain(payload, limits, lines);
            });
    });
}

Status check_reel(ByteView reel, const DecodeOptions& options)
{
    MESHREEL_TRY(const Animation animation, decode(reel, options));
    return Ok{};
}

} // namespace meshreel
