/// Point caches: positions without a mesh. PC2 (little-endian, evenly spaced) and MDD (big-endian, with times).
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// Positions of a PC2 file over the triangles and appearance of `mesh` (its positions are not used).
/// The file counts time in frames of the scene that it was written from: sample i stands at frame start + i * rate,
/// which is second (start + i * rate) / fps; without options.fps, 24 are taken with a warning.
/// @fails bad_input: by byte; the vertex counts differ. @cost O(F V)
Result<Animation> parse_pc2(ByteView bytes, Animation mesh, const LoadOptions& options);

/// Positions of an MDD file likewise. It has a time in seconds for each frame; options.fps > 0 replaces them.
Result<Animation> parse_mdd(ByteView bytes, Animation mesh, const LoadOptions& options);

/// The bytes of a PC2 file: start and rate in frames of meta.fps a second, or of 24 where that is unknown.
/// @fails unsupported: the frames are not evenly spaced.
Result<Bytes> write_pc2(const Animation& animation);

/// The bytes of an MDD file. @fails unsupported: two times are the same float32.
Result<Bytes> write_mdd(const Animation& animation);

Result<Animation> load_pc2(const std::string& path, const LoadOptions& options);
Result<std::unique_ptr<FrameSource>> open_pc2(const std::string& path, const LoadOptions& options);
Result<Animation> load_mdd(const std::string& path, const LoadOptions& options);
Result<std::unique_ptr<FrameSource>> open_mdd(const std::string& path, const LoadOptions& options);
Status save_pc2(const Animation& animation, const std::string& path, const SaveOptions& options);
Status save_mdd(const Animation& animation, const std::string& path, const SaveOptions& options);
/// Frame by frame, as they come.
Status save_pc2_frames(FrameSource& frames, const std::string& path, const SaveOptions& options);
Status save_mdd_frames(FrameSource& frames, const std::string& path, const SaveOptions& options);

} // namespace meshreel::io
