/// Frames read, checked, remembered, gathered.
// SPDX-License-Identifier: MIT
#include "meshreel/io/streamed_frames.h"

#include <algorithm>
#include <cstring>

#include "meshreel/base/text.h"
#include "meshreel/io/frames.h"

namespace meshreel::io {

namespace {

/// Never 0.
std::uint64_t hash_of_frame(std::span<const float> positions)
{
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const float value : positions) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0xbf58476d1ce4e5b9u;
        hash ^= hash >> 29;
    }
    return hash | 1;
}

} // namespace

Result<MatrixView<const float>> StreamedFrames::frames(std::size_t first, std::size_t count, Matrix<float>& room)
{
    const std::size_t width = 3ul * still_.vertex_count;
    if (room.rows != count || room.cols != width) room = Matrix<float>(count, width);
    for (std::size_t i = 0; i < count; ++i) {
        MESHREEL_CHECK(in_file(read_frame(first + i, room.row(i)), file(first + i)));
        MESHREEL_CHECK(in_file(check(first + i, room.row(i)), file(first + i)));
    }
    return MatrixView<const float>(room.view());
}

Status StreamedFrames::check(std::size_t i, std::span<const float> positions)
{
    MESHREEL_CHECK(check_finite(positions, number(i)));
    hashes_.resize(frame_count());
    const std::uint64_t hash = hash_of_frame(positions);
    if (hashes_[i] != 0 && hashes_[i] != hash)
        return Error{
            ErrorCode::io, concat("frame ", number(i), " is not what it was when it was read first"), {}, {}, {}};
    hashes_[i] = hash;
    return Ok{};
}

Result<Animation> gathered(FrameSource& source, const LoadOptions& options)
{
    const Animation& still = source.still();
    MESHREEL_CHECK(within(options.limits, still.vertex_count, still.triangles.size(), still.frame_count()));
    Animation animation = still;
    const std::size_t F = still.frame_count();
    animation.positions.resize(F * still.vertex_count * 3);
    Matrix<float> room;
    for (std::size_t f = 0; f < F; ++f) {
        if (f > 0) report(options.progress, "reading", static_cast<double>(f) / static_cast<double>(F));
        MESHREEL_TRY(const MatrixView<const float> frame, source.frames(f, 1, room));
        std::ranges::copy(frame.values(), animation.frame(f).begin());
    }
    return animation;
}

Result<std::unique_ptr<FrameSource>> held_if_small(std::unique_ptr<FrameSource> source, const LoadOptions& options)
{
    constexpr std::uint64_t small = 256 << 20;
    const std::uint64_t bytes = 12 * std::uint64_t{source->still().vertex_count} * source->frame_count();
    if (bytes > small || bytes > options.limits.max_memory) return source;
    MESHREEL_TRY(Animation animation, gathered(*source, options));
    return std::unique_ptr<FrameSource>(std::make_unique<OwnedFrames>(std::move(animation)));
}

} // namespace meshreel::io
