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

Status save_cache(Result<Bytes> bytes, const Animation& animation, const std::string& path, const SaveOptions& options)
{
    if (!bytes.ok()) return in_file(Status(std::move(bytes).error()), path);
    if (!animation.appearance.attributes.empty())
        tell(options, "a point cache holds positions only: keep the mesh for its attributes and materials");
    return write_file(path, *bytes, options.overwrite);
}

} // namespace

Result<Bytes> write_pc2(const Animation& animation)
{
    MESHREEL_CHECK(check_counts(animation));
    const auto spacing = even_spacing(animation);
    if (!spacing)
        return unsupported("the frames are not evenly spaced in time, and a PC2 file cannot say so; an MDD file can",
                           "times");
    const double fps = animation.meta.fps > 0 ? animation.meta.fps : default_fps;
    Bytes bytes{'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', 0};
    bytes.reserve(32 + animation.positions.size() * 4);
    append_number(bytes, std::int32_t(1), ByteOrder::little);
    append_number(bytes, static_cast<std::int32_t>(animation.vertex_count), ByteOrder::little);
    append_number(bytes, static_cast<float>(animation.times_s.front() * fps), ByteOrder::little);
    append_number(bytes, static_cast<float>(*spacing * fps), ByteOrder::little);
    append_number(bytes, static_cast<std::int32_t>(animation.frame_count()), ByteOrder::little);
    for (float value : animation.positions) append_number(bytes, value, ByteOrder::little);
    return bytes;
}

Result<Bytes> write_mdd(const Animation& animation)
{
    MESHREEL_CHECK(check_counts(animation));
    Bytes bytes;
    bytes.reserve(8 + animation.frame_count() * 4 + animation.positions.size() * 4);
    append_number(bytes, static_cast<std::int32_t>(animation.frame_count()), ByteOrder::big);
    append_number(bytes, static_cast<std::int32_t>(animation.vertex_count), ByteOrder::big);
    for (std::size_t f = 0; f < animation.frame_count(); ++f) {
        const auto time = static_cast<float>(animation.times_s[f]);
        if (f > 0 && !(time > static_cast<float>(animation.times_s[f - 1])))
            return unsupported(
                concat("frames ", f - 1, " and ", f, " are at the same time in the float32 of an MDD file"), "times");
        append_number(bytes, time, ByteOrder::big);
    }
    for (float value : animation.positions) append_number(bytes, value, ByteOrder::big);
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

} // namespace meshreel::io
