/// Stanford PLY: one mesh a file, one file a frame; text, little- or big-endian.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// The mesh of a PLY file, an animation of one frame. Carried: "normal", "uv0", "color0" of vertices; "uv0" of corners
/// (the face property texcoord); "face_color"; every other scalar property under its own name, name_0, name_1, ...
/// together as one. @fails bad_input: by line or byte. @cost O(bytes)
Result<Animation> parse_ply(ByteView bytes, const LoadOptions& options);

/// One frame as a PLY file, little-endian, or text where options.binary is false; read back to the same bits.
Result<Bytes> write_ply(const Animation& animation, std::size_t frame, const SaveOptions& options);

/// A file or a sequence.
Result<Animation> load_ply(const std::string& path, const LoadOptions& options);
Result<std::unique_ptr<FrameSource>> open_ply(const std::string& path, const LoadOptions& options);
Status save_ply(const Animation& animation, const std::string& path, const SaveOptions& options);

} // namespace meshreel::io
