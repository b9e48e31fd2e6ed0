/// Reading PC2 and MDD: a header, then all positions, frame after frame.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/point_cache.h"

namespace meshreel::io {

namespace {

using ParseCache = Result<Animation> (*)(ByteView bytes, Animation mesh, const LoadOptions& options);

/// What the header of either format says.
struct CacheHeader {
    std::uint64_t vertices = 0;
    std::uint64_t frames = 0;
};

Status check_vertices(const CacheHeader& header, const Animation& mesh, Place place)
{
    if (header.vertices == mesh.vertex_count) return Ok{};
    return bad_input(concat("the cache has ", header.vertices, " vertices, the mesh has ", mesh.vertex_count),
                     "vertex_count", place);
}

/// The block of all positions behind a header. @fails bad_input: the file is shorter than its header says.
Result<ByteView> position_block(BinaryReader& reader, const CacheHeader& header, const LoadOptions& options)
{
    const std::uint64_t frame_size = header.vertices * 12;
    if (header.frames > reader.left() / frame_size)
        return bad_input(concat("the header promises ", header.frames, " frames of ", header.vertices,
                                " vertices, but ", reader.left(), " bytes are left for ", header.frames * frame_size),
                         "positions", at_byte(reader.offset()));
    MESHREEL_TRY(const ByteView block, reader.bytes(header.frames * frame_size, "positions"));
    if (reader.left() > 0) tell(options, concat(reader.left(), " bytes behind the last frame are left out"));
    return block;
}

/// Fills animation.positions with the selected frames of a block.
Status copy_frames(Animation& animation, ByteView block, ByteOrder order, const Selection& chosen)
{
    const std::size_t frame_size = animation.vertex_count * 12ul;
    animation.positions.resize(chosen.count * animation.vertex_count * 3);
    for (std::uint64_t i = 0; i < chosen.count; ++i) {
        float* frame = animation.positions.data() + i * animation.vertex_count * 3;
        copy_floats(block.subspan(chosen[i] * frame_size, frame_size), order, frame);
        MESHREEL_CHECK(check_finite({frame, animation.vertex_count * 3ul}, chosen[i]));
    }
    return Ok{};
}

Result<Animation> load_cache(const std::string& path, const LoadOptions& options, ParseCache parse)
{
    MESHREEL_CHECK(check_fps(options));
    if (options.mesh.empty())
        return Error{ErrorCode::usage,
                     "a point cache has positions only: name the mesh that they belong to (--mesh)",
                     "mesh",
                     path,
                     {}};
    LoadOptions mesh_options;
    mesh_options.limits = options.limits;
    mesh_options.warn = options.warn;
    mesh_options.frames = {0, 0, 1};
    MESHREEL_TRY(Animation mesh, load(options.mesh, mesh_options));
    MESHREEL_TRY(const Bytes bytes, read_file(path, options.limits));
    return in_file(parse(bytes, std::move(mesh), named_warnings(options, path)), path);
}

struct Pc2Header {
    CacheHeader counts;
    double start = 0, rate = 1; ///< in frames of the scene
};

Result<Pc2Header> read_pc2_header(BinaryReader& reader)
{
    MESHREEL_TRY(const std::string signature, reader.name(12, "signature"));
    if (signature != "POINTCACHE2")
        return bad_input("this is no PC2 file: it does not begin with POINTCACHE2", "signature", at_byte(0));
    MESHREEL_TRY(const auto version, reader.number<std::int32_t>("version"));
    if (version != 1) return unsupported(concat("version ", version, " of PC2; version 1 is known"), "version");
    Pc2Header header;
    MESHREEL_TRY(const auto vertices, reader.number<std::int32_t>("vertex_count"));
    MESHREEL_TRY(header.start, reader.number<float>("start"));
    MESHREEL_TRY(header.rate, reader.number<float>("rate"));
    MESHREEL_TRY(const auto frames, reader.number<std::int32_t>("frame_count"));
    if (vertices <= 0) return bad_input(concat(vertices, " vertices"), "vertex_count", at_byte(16));
    if (frames <= 0) return bad_input(concat(frames, " frames"), "frame_count", at_byte(28));
    if (!std::isfinite(header.start)) return bad_input("the start frame is not a finite number", "start", at_byte(20));
    if (!std::isfinite(header.rate) || header.rate < 0)
        return bad_input("the sampling rate is not a number above 0", "rate", at_byte(24));
    header.counts = {static_cast<std::uint64_t>(vertices), static_cast<std::uint64_t>(frames)};
    return header;
}

void give_pc2_times(Animation& animation, const Pc2Header& header, const Selection& chosen, const LoadOptions& options)
{
    if (header.rate == 0) tell(options, "the sampling rate is 0; one sample a frame is taken");
    const double rate = header.rate == 0 ? 1.0 : header.rate;
    give_times(animation, chosen, options);
    const double fps = options.fps > 0 ? options.fps : default_fps;
    for (std::uint64_t i = 0; i < chosen.count; ++i)
        animation.times_s[i] = (header.start + static_cast<double>(chosen[i]) * rate) / fps;
    animation.meta.fps = animation.meta.fps / rate;
}

} // namespace

Result<Animation> parse_pc2(ByteView bytes, Animation mesh, const LoadOptions& options)
{
    BinaryReader reader(bytes, ByteOrder::little);
    MESHREEL_TRY(const Pc2Header header, read_pc2_header(reader));
    MESHREEL_CHECK(check_vertices(header.counts, mesh, at_byte(16)));
    MESHREEL_TRY(const Selection chosen, select_frames(options.frames, header.counts.frames));
    MESHREEL_CHECK(within(options.limits, header.counts.vertices, mesh.triangles.size(), chosen.count));
    MESHREEL_TRY(const ByteView block, position_block(reader, header.counts, options));
    MESHREEL_CHECK(copy_frames(mesh, block, ByteOrder::little, chosen));
    give_pc2_times(mesh, header, chosen, options);
    return mesh;
}

Result<Animation> parse_mdd(ByteView bytes, Animation mesh, const LoadOptions& options)
{
    BinaryReader reader(bytes, ByteOrder::big);
    MESHREEL_TRY(const auto frames, reader.number<std::int32_t>("frame_count"));
    MESHREEL_TRY(const auto vertices, reader.number<std::int32_t>("vertex_count"));
    if (frames <= 0) return bad_input(concat(frames, " frames; is this an MDD file?"), "frame_count", at_byte(0));
    if (vertices <= 0)
        return bad_input(concat(vertices, " vertices; is this an MDD file?"), "vertex_count", at_byte(4));
    const CacheHeader header{static_cast<std::uint64_t>(vertices), static_cast<std::uint64_t>(frames)};
    MESHREEL_CHECK(check_vertices(header, mesh, at_byte(4)));
    MESHREEL_TRY(const Selection chosen, select_frames(options.frames, header.frames));
    MESHREEL_CHECK(within(options.limits, header.vertices, mesh.triangles.size(), chosen.count));
    MESHREEL_TRY(const ByteView times, reader.bytes(header.frames * 4, "times"));
    MESHREEL_TRY(const ByteView block, position_block(reader, header, options));
    MESHREEL_CHECK(copy_frames(mesh, block, ByteOrder::big, chosen));
    if (options.fps > 0) {
        give_times(mesh, chosen, options);
        return mesh;
    }
    mesh.meta.fps = 0.0;
    mesh.times_s.resize(chosen.count);
    for (std::uint64_t i = 0; i < chosen.count; ++i) {
        mesh.times_s[i] = number_at<float>(times.data() + chosen[i] * 4, ByteOrder::big);
        const bool later = std::isfinite(mesh.times_s[i]) && (i == 0 || mesh.times_s[i] > mesh.times_s[i - 1]);
        if (!later)
            return bad_input(
                concat("the time of frame ", chosen[i], " is not after the one before; fps replaces the times"),
                "times", at_byte(8 + chosen[i] * 4));
    }
    return mesh;
}

Result<Animation> load_pc2(const std::string& path, const LoadOptions& options)
{
    return load_cache(path, options, parse_pc2);
}
Result<Animation> load_mdd(const std::string& path, const LoadOptions& options)
{
    return load_cache(path, options, parse_mdd);
}

} // namespace meshreel::io
