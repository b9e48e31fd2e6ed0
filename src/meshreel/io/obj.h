/// Wavefront OBJ: one mesh a file, one file a frame.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// The mesh of an OBJ file, an animation of one frame. Carried: "uv0", "normal" (corners), "color0" (vertices),
/// "material", "group", "smoothing" (triangles); the names after mtllib as assets without bytes.
/// @fails bad_input: by line. @cost O(bytes)
Result<Animation> parse_obj(ByteView bytes, const LoadOptions& options);

/// One frame as an OBJ file; numbers read back to the same float32, triangles stay in their order.
Result<Bytes> write_obj(const Animation& animation, std::size_t frame, const SaveOptions& options);

/// A file or a sequence, with the material libraries beside it.
Result<Animation> load_obj(const std::string& path, const LoadOptions& options);
Result<std::unique_ptr<FrameSource>> open_obj(const std::string& path, const LoadOptions& options);
Status save_obj(const Animation& animation, const std::string& path, const SaveOptions& options);

} // namespace meshreel::io
