/// Object File Format: OFF, and its kin with colours (C), normals (N) and texture coordinates (ST).
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// The mesh of an OFF file, an animation of one frame. Carried: "normal", "color0", "uv0" of vertices, "face_color".
/// @fails bad_input: by line; unsupported: four-dimensional or binary files. @cost O(bytes)
Result<Animation> parse_off(ByteView bytes, const LoadOptions& options);

/// One frame as an OFF file, its first word saying what a vertex has; read back to the same float32.
Result<Bytes> write_off(const Animation& animation, std::size_t frame, const SaveOptions& options);

/// A file or a sequence.
Result<Animation> load_off(const std::string& path, const LoadOptions& options);
Result<std::unique_ptr<FrameSource>> open_off(const std::string& path, const LoadOptions& options);
Status save_off(const Animation& animation, const std::string& path, const SaveOptions& options);

} // namespace meshreel::io
