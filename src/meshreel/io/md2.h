/// Quake II models: one mesh, key frames of bytes, clips by the names of their frames.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// Frames a second at which the format's engine plays it; the file does not say.
constexpr double md2_fps = 10.0;

/// One clip: consecutive frames whose names agree up to their number ("stand01", "stand02", ...).
struct Md2Clip {
    std::string name;
    std::uint64_t first = 0, count = 0;
};

/// The clips that a list of frame names makes. Where a number has three digits and more, all but the last two belong to
/// the name ("pain101" is frame 1 of "pain1"), unless it goes on counting ("run99", "run100").
std::vector<Md2Clip> md2_clips(std::span<const std::string> frame_names);

/// All frames, or those of options.clip. Carried: "uv0" of corners (texels over the skin's size, v down), the skins'
/// names as materials. Triangles are clockwise seen from outside, as in the file.
/// @fails bad_input: by byte; usage: no such clip. @cost O(F V)
Result<Animation> parse_md2(ByteView bytes, const LoadOptions& options);

Result<Animation> load_md2(const std::string& path, const LoadOptions& options);

} // namespace meshreel::io
