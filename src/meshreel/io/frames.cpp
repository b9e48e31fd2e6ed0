/// Frame ranges and times.
// SPDX-License-Identifier: MIT
#include "meshreel/io/frames.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "meshreel/base/text.h"

namespace meshreel::io {

namespace {

/// 24, 29.97: a rate as people write it.
std::string rate(double fps)
{
    char text[32];
    const int length = std::snprintf(text, sizeof text, "%g", fps);
    return std::string(text, static_cast<std::size_t>(length));
}

} // namespace

Result<Selection> select_frames(const FrameRange& range, std::uint64_t source_count)
{
    if (source_count == 0) return bad_input("there is no frame", "frame_count");
    if (range.step == 0) return Error{ErrorCode::usage, "the step between frames is 0", "frames", {}, {}};
    const std::uint64_t last = std::min(range.last, source_count - 1);
    if (range.first > last)
        return Error{ErrorCode::usage,
                     concat("frames from ", range.first, " to ", last, " are asked for, of ", source_count),
                     "frames",
                     {},
                     {}};
    return Selection{range.first, range.step, (last - range.first) / range.step + 1};
}

void tell(const LoadOptions& options, std::string sentence)
{
    if (options.warn) options.warn(std::move(sentence));
}

void tell(const SaveOptions& options, std::string sentence)
{
    if (options.warn) options.warn(std::move(sentence));
}

LoadOptions named_warnings(const LoadOptions& options, const std::string& file)
{
    LoadOptions named = options;
    if (options.warn)
        named.warn = [file, warn = options.warn](const std::string& sentence) { warn(file + ": " + sentence); };
    return named;
}

void give_times(Animation& animation, const Selection& selection, const LoadOptions& options, double fallback_fps)
{
    const double fps = options.fps > 0 ? options.fps : fallback_fps;
    animation.times_s.resize(selection.count);
    for (std::uint64_t i = 0; i < selection.count; ++i) animation.times_s[i] = static_cast<double>(selection[i]) / fps;
    animation.meta.fps = options.fps > 0 ? options.fps / static_cast<double>(selection.step) : 0.0;
    if (options.fps <= 0 && selection.count > 1)
        tell(options, concat("the source does not say how fast it plays: ", rate(fps), " frames a second are taken"));
}

std::optional<double> even_spacing(const Animation& animation)
{
    const std::size_t frames = animation.frame_count();
    if (frames < 2) return animation.meta.fps > 0 ? 1.0 / animation.meta.fps : 1.0 / default_fps;
    const double start = animation.times_s.front();
    const double spacing = (animation.times_s.back() - start) / static_cast<double>(frames - 1);
    for (std::size_t f = 0; f < frames; ++f)
        if (std::abs(animation.times_s[f] - start - static_cast<double>(f) * spacing) > 1e-3 * spacing)
            return std::nullopt;
    return spacing;
}

Status check_fps(const LoadOptions& options)
{
    if (std::isfinite(options.fps) && options.fps >= 0) return Ok{};
    return Error{ErrorCode::usage, "frames a second must be a number above 0", "fps", {}, {}};
}

Status check_finite(std::span<const float> positions, std::uint64_t frame)
{
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (!std::isfinite(positions[i]))
            return bad_input(concat("frame ", frame, ", vertex ", i / 3, ", ", std::string(1, "xyz"[i % 3]), " is ",
                                    std::isnan(positions[i]) ? "not a number" : "infinite"),
                             "positions");
    return Ok{};
}

} // namespace meshreel::io
