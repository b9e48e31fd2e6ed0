/// Reading PC2 and MDD: a header, then all positions, frame after frame.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/point_cache.h"
#include "meshreel/io/streamed_frames.h"

namespace meshreel::io {

namespace {

/// Where the positions are, and which of them are wanted.
struct CachePlan {
    Selection chosen;
    std::uint64_t offset = 0; ///< of the positions
    ByteOrder order = ByteOrder::little;
};

/// A file of which the beginning is at hand.
struct CacheFile {
    ByteView head;
    std::uint64_t size = 0;
    std::uint64_t frames_held = 0; ///< how many are to be in memory at once; 0: all
};

/// Reads what stands before the positions; gives the mesh its times, and takes its positions.
using PlanCache = Result<CachePlan> (*)(const CacheFile& file, Animation& mesh, const LoadOptions& options);

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

/// The counts are bearable, and all positions are there, from byte `offset` on.
Status check_cache(const CacheHeader& header, const CacheFile& file, const CachePlan& plan, const LoadOptions& options)
{
    const std::uint64_t frame_size = header.vertices * 12, left = file.size - std::min(file.size, plan.offset);
    if (header.frames > left / frame_size)
        return bad_input(concat("the header promises ", header.frames, " frames of ", header.vertices,
                                " vertices, but ", left, " bytes are left for ", header.frames * frame_size),
                         "positions", at_byte(plan.offset));
    if (left > header.frames * frame_size)
        tell(options, concat(left - header.frames * frame_size, " bytes behind the last frame are left out"));
    return Ok{};
}

Status check_cache_counts(const CacheHeader& header, const CacheFile& file, const Animation& mesh,
                          const LoadOptions& options)
{
    MESHREEL_TRY(const Selection chosen, select_frames(options.frames, header.frames));
    MESHREEL_CHECK(within(chosen.count, options.limits.max_frames, "frame_count"));
    return within(options.limits, header.vertices, mesh.triangles.size(),
                  file.frames_held > 0 ? file.frames_held : chosen.count);
}

/// The frames of a file that is in memory.
Result<Animation> parse_cache(ByteView bytes, Animation mesh, const LoadOptions& options, PlanCache plan_cache)
{
    MESHREEL_TRY(const CachePlan plan, plan_cache({bytes, bytes.size(), 0}, mesh, options));
    const std::size_t frame_size = mesh.vertex_count * 12ul;
    mesh.positions.resize(plan.chosen.count * mesh.vertex_count * 3);
    for (std::uint64_t i = 0; i < plan.chosen.count; ++i) {
        copy_floats(bytes.subspan(plan.offset + plan.chosen[i] * frame_size, frame_size), plan.order,
                    mesh.frame(i).data());
        MESHREEL_CHECK(check_finite(mesh.frame(i), plan.chosen[i]));
    }
    return mesh;
}

/// The frames of a file that is read where it is asked to.
class CacheFrames : public StreamedFrames {
public:
    CacheFrames(FileSource source, Animation mesh, const CachePlan& plan, std::string path)
        : StreamedFrames(std::move(mesh)), source_(std::move(source)), plan_(plan), path_(std::move(path))
    {
    }

private:
    Status read_frame(std::size_t i, std::span<float> positions) override
    {
        MESHREEL_TRY(const Bytes bytes,
                     source_.fetch(plan_.offset + plan_.chosen[i] * positions.size_bytes(), positions.size_bytes()));
        copy_floats(bytes, plan_.order, positions.data());
        return Ok{};
    }
    std::uint64_t number(std::size_t i) const override { return plan_.chosen[i]; }
    const std::string& file(std::size_t) const override { return path_; }

    FileSource source_;
    CachePlan plan_;
    std::string path_;
};

Result<Animation> load_cache_mesh(const std::string& path, const LoadOptions& options)
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
    return load(options.mesh, mesh_options);
}

Result<Animation> load_cache(const std::string& path, const LoadOptions& options, PlanCache plan_cache)
{
    MESHREEL_TRY(Animation mesh, load_cache_mesh(path, options));
    MESHREEL_TRY(const Bytes bytes, read_file(path, options.limits));
    return in_file(parse_cache(bytes, std::move(mesh), named_warnings(options, path), plan_cache), path);
}

/// The bytes before the positions: as many as the format's header may have.
using HeadSize = Result<std::uint64_t> (*)(FileSource& source);

Result<std::unique_ptr<FrameSource>> open_cache(const std::string& path, const LoadOptions& options,
                                                PlanCache plan_cache, HeadSize head_size)
{
    if (!is_regular_file(path)) { // a pipe is read once
        MESHREEL_TRY(Animation animation, load_cache(path, options, plan_cache));
        return std::unique_ptr<FrameSource>(std::make_unique<OwnedFrames>(std::move(animation)));
    }
    MESHREEL_TRY(Animation mesh, load_cache_mesh(path, options));
    MESHREEL_TRY(FileSource source, FileSource::open(path));
    MESHREEL_TRY(const std::uint64_t size, head_size(source));
    MESHREEL_TRY(const Bytes head,
                 source.fetch(0, static_cast<std::size_t>(std::min({size, source.size(), options.limits.max_memory}))));
    MESHREEL_TRY(const CachePlan plan,
                 in_file(plan_cache({head, source.size(), 1}, mesh, named_warnings(options, path)), path));
    mesh.positions = {};
    return std::unique_ptr<FrameSource>(std::make_unique<CacheFrames>(std::move(source), std::move(mesh), plan, path));
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

Result<CachePlan> plan_pc2(const CacheFile& file, Animation& mesh, const LoadOptions& options)
{
    BinaryReader reader(file.head, ByteOrder::little);
    MESHREEL_TRY(const Pc2Header header, read_pc2_header(reader));
    MESHREEL_CHECK(check_vertices(header.counts, mesh, at_byte(16)));
    MESHREEL_CHECK(check_cache_counts(header.counts, file, mesh, options));
    MESHREEL_TRY(const Selection chosen, select_frames(options.frames, header.counts.frames));
    const CachePlan plan{chosen, reader.offset(), ByteOrder::little};
    MESHREEL_CHECK(check_cache(header.counts, file, plan, options));
    give_pc2_times(mesh, header, chosen, options);
    return plan;
}

Result<std::uint64_t> pc2_head_size(FileSource&)
{
    return std::uint64_t{32};
}

/// The times of the chosen frames, as the file has them.
Status give_mdd_times(Animation& mesh, ByteView times, const Selection& chosen)
{
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
    return Ok{};
}

Result<CachePlan> plan_mdd(const CacheFile& file, Animation& mesh, const LoadOptions& options)
{
    BinaryReader reader(file.head, ByteOrder::big);
    MESHREEL_TRY(const auto frames, reader.number<std::int32_t>("frame_count"));
    MESHREEL_TRY(const auto vertices, reader.number<std::int32_t>("vertex_count"));
    if (frames <= 0) return bad_input(concat(frames, " frames; is this an MDD file?"), "frame_count", at_byte(0));
    if (vertices <= 0)
        return bad_input(concat(vertices, " vertices; is this an MDD file?"), "vertex_count", at_byte(4));
    const CacheHeader header{static_cast<std::uint64_t>(vertices), static_cast<std::uint64_t>(frames)};
    MESHREEL_CHECK(check_vertices(header, mesh, at_byte(4)));
    MESHREEL_CHECK(check_cache_counts(header, file, mesh, options));
    MESHREEL_TRY(const Selection chosen, select_frames(options.frames, header.frames));
    MESHREEL_TRY(const ByteView times, reader.bytes(header.frames * 4, "times"));
    const CachePlan plan{chosen, reader.offset(), ByteOrder::big};
    MESHREEL_CHECK(check_cache(header, file, plan, options));
    if (options.fps > 0)
        give_times(mesh, chosen, options);
    else
        MESHREEL_CHECK(give_mdd_times(mesh, times, chosen));
    return plan;
}

/// A header and a time a frame; a number of frames that makes no sense is told by plan_mdd.
Result<std::uint64_t> mdd_head_size(FileSource& source)
{
    if (source.size() < 8) return source.size();
    MESHREEL_TRY(const Bytes counts, source.fetch(0, 8));
    const auto frames = number_at<std::int32_t>(counts.data(), ByteOrder::big);
    return 8 + 4 * static_cast<std::uint64_t>(std::max(frames, 0));
}

} // namespace

Result<Animation> parse_pc2(ByteView bytes, Animation mesh, const LoadOptions& options)
{
    return parse_cache(bytes, std::move(mesh), options, plan_pc2);
}
Result<Animation> parse_mdd(ByteView bytes, Animation mesh, const LoadOptions& options)
{
    return parse_cache(bytes, std::move(mesh), options, plan_mdd);
}

Result<Animation> load_pc2(const std::string& path, const LoadOptions& options)
{
    return load_cache(path, options, plan_pc2);
}
Result<Animation> load_mdd(const std::string& path, const LoadOptions& options)
{
    return load_cache(path, options, plan_mdd);
}
Result<std::unique_ptr<FrameSource>> open_pc2(const std::string& path, const LoadOptions& options)
{
    return open_cache(path, options, plan_pc2, pc2_head_size);
}
Result<std::unique_ptr<FrameSource>> open_mdd(const std::string& path, const LoadOptions& options)
{
    return open_cache(path, options, plan_mdd, mdd_head_size);
}

} // namespace meshreel::io
