/// Writing PC2 and MDD.
// SPDX-License-Identifier: MIT
#include <limits>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/point_cache.h"

namespace meshreel::io {

namespace {

Status check_counts(const Animation& animation)
{
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    if (animation.vertex_count <= most && animation.frame_count() <= most) return Ok{};
    return unsupported("a point cache counts vertices and frames in 31 bits");
}

void warn_of_appearance(const Animation& animation, const SaveOptions& options)
{
    if (!animation.appearance.attributes.empty())
        tell(options, "a point cache holds positions only: keep the mesh for its attributes and materials");
}

Status save_cache(Result<Bytes> bytes, const Animation& animation, const std::string& path, const SaveOptions& options)
{
    if (!bytes.ok()) return in_file(Status(std::move(bytes).error()), path);
    warn_of_appearance(animation, options);
    return write_file(path, *bytes, options.overwrite);
}

/// What stands before the positions.
Result<Bytes> pc2_head(const Animation& animation)
{
    MESHREEL_CHECK(check_counts(animation));
    const auto spacing = even_spacing(animation);
    if (!spacing)
        return unsupported("the frames are not evenly spaced in time, and a PC2 file cannot say so; an MDD file can",
                           "times");
    const double fps = animation.meta.fps > 0 ? animation.meta.fps : default_fps;
    Bytes bytes{'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', 0};
    append_number(bytes, std::int32_t(1), ByteOrder::little);
    append_number(bytes, static_cast<std::int32_t>(animation.vertex_count), ByteOrder::little);
    append_number(bytes, static_cast<float>(animation.times_s.front() * fps), ByteOrder::little);
    append_number(bytes, static_cast<float>(*spacing * fps), ByteOrder::little);
    append_number(bytes, static_cast<std::int32_t>(animation.frame_count()), ByteOrder::little);
    return bytes;
}

/// Likewise.
Result<Bytes> mdd_head(const Animation& animation)
{
    MESHREEL_CHECK(check_counts(animation));
    Bytes bytes;
    append_number(bytes, static_cast<std::int32_t>(animation.frame_count()), ByteOrder::big);
    append_number(bytes, static_cast<std::int32_t>(animation.vertex_count), ByteOrder::big);
    for (std::size_t f = 0; f < animation.frame_count(); ++f) {
        const auto time = static_cast<float>(animation.times_s[f]);
        if (f > 0 && !(time > static_cast<float>(animation.times_s[f - 1])))
            return unsupported(
                concat("frames ", f - 1, " and ", f, " are at the same time in the float32 of an MDD file"), "times");
        append_number(bytes, time, ByteOrder::big);
    }
    return bytes;
}

void append_positions(Bytes& bytes, std::span<const float> positions, ByteOrder order)
{
    bytes.reserve(bytes.size() + positions.size_bytes());
    for (const float value : positions) append_number(bytes, value, order);
}

Status save_cache_frames(ByteView head, FrameSource& frames, AtomicFile file, ByteOrder order)
{
    MESHREEL_CHECK(file.write(head));
    MESHREEL_CHECK(for_frame_runs(frames, [&](std::size_t, MatrixView<const float> run) {
        Bytes bytes;
        append_positions(bytes, run.values(), order);
        return file.write(bytes);
    }));
    return file.commit();
}

} // namespace

Result<Bytes> write_pc2(const Animation& animation)
{
    MESHREEL_TRY(Bytes bytes, pc2_head(animation));
    append_positions(bytes, animation.positions, ByteOrder::little);
    return bytes;
}

Result<Bytes> write_mdd(const Animation& animation)
{
    MESHREEL_TRY(Bytes bytes, mdd_head(animation));
    append_positions(bytes, animation.positions, ByteOrder::big);
    return bytes;
}

Status save_pc2(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    return save_cache(write_pc2(animation), animation, path, options);
}

Status save_mdd(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    return save_cache(write_mdd(animation), animation, path, options);
}

Status save_pc2_frames(FrameSource& frames, const std::string& path, const SaveOptions& options)
{
    MESHREEL_TRY(Bytes head, in_file(pc2_head(frames.still()), path));
    warn_of_appearance(frames.still(), options);
    MESHREEL_TRY(AtomicFile file, AtomicFile::create(path, options.overwrite));
    return save_cache_frames(head, frames, std::move(file), ByteOrder::little);
}

Status save_mdd_frames(FrameSource& frames, const std::string& path, const SaveOptions& options)
{
    MESHREEL_TRY(Bytes head, in_file(mdd_head(frames.still()), path));
    warn_of_appearance(frames.still(), options);
    MESHREEL_TRY(AtomicFile file, AtomicFile::create(path, options.overwrite));
    return save_cache_frames(head, frames, std::move(file), ByteOrder::big);
}

} // namespace meshreel::io
