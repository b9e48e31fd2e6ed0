/// Which frames of a source are read, and when they are shown.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "meshreel/io/io.h"

namespace meshreel::io {

/// Frames a second that are taken, with a warning, where neither file nor caller says a rate.
constexpr double default_fps = 24.0;

/// The frames first, first + step, ... of a source, `count` of them.
struct Selection {
    std::uint64_t first = 0;
    std::uint64_t step = 1;
    std::uint64_t count = 0;

    std::uint64_t operator[](std::uint64_t i) const { return first + i * step; }
};

/// The part of a range that a source with `source_count` frames has.
/// @fails usage: a step of 0, or nothing left; bad_input: the source is empty.
Result<Selection> select_frames(const FrameRange& range, std::uint64_t source_count);

/// Tells a warning to whoever asked.
void tell(const LoadOptions& options, std::string sentence);
void tell(const SaveOptions& options, std::string sentence);

/// The same options, each warning beginning with the file's name.
LoadOptions named_warnings(const LoadOptions& options, const std::string& file);

/// Times for a source that has none: frame i of the source at i / fps seconds, where fps is the option's or, with a
/// warning, `fallback_fps`. meta.fps is the rate of the selected frames, or 0 where it was not given.
void give_times(Animation& animation, const Selection& selection, const LoadOptions& options,
                double fallback_fps = default_fps);

/// The spacing of an animation's frames, seconds. Nothing: they are not evenly spaced within 0.1 % of a frame.
std::optional<double> even_spacing(const Animation& animation);

/// fps of the options must be finite and not negative. @fails usage.
Status check_fps(const LoadOptions& options);

/// Refuses NaN and infinity in one frame. @fails bad_input: naming frame and vertex.
Status check_finite(std::span<const float> positions, std::uint64_t frame);

} // namespace meshreel::io
