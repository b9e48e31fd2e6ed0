/// Animations as one mesh file a frame: what OBJ, PLY and OFF share.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "meshreel/io/file_set.h"
#include "meshreel/io/io.h"

namespace meshreel::io {

/// Reads one mesh from the bytes of a file: an animation of one frame.
using ParseMesh = Result<Animation> (*)(ByteView bytes, const LoadOptions& options);
/// The bytes of the file of one frame.
using WriteMesh = Result<Bytes> (*)(const Animation& animation, std::size_t frame, const SaveOptions& options);

/// How the files of a format are read.
struct MeshFormat {
    ParseMesh parse;
    /// Fetches what the first file, of that path, names; null where a format names nothing.
    void (*complete)(Animation& first, const std::string& path, const LoadOptions& options) = nullptr;
};

/// Reads a file, or a sequence (see Pattern). Triangles and appearance are those of the first frame.
/// Frame i of the source is shown at i / fps seconds.
/// @fails io: no such file; bad_input: a file is broken, or its vertex count or triangles differ from the first one's.
Result<Animation> load_sequence(const std::string& path, const LoadOptions& options, const MeshFormat& format);

/// The same, of which only the first file is read yet, unless all are small. @fails likewise.
Result<std::unique_ptr<FrameSource>> open_sequence(const std::string& path, const LoadOptions& options,
                                                   const MeshFormat& format);

/// Where frames go and how one becomes bytes.
struct SequenceTarget {
    const std::string& path; ///< of one file, or a pattern
    WriteMesh write;
};

/// Writes a file, or a file a frame where the path is a pattern (numbers from 0) into `files`; nothing appears yet.
/// @fails usage: several frames and no pattern; io.
Status add_sequence(FileSet& files, const Animation& animation, const SequenceTarget& target,
                    const SaveOptions& options);

/// The same, and makes all files appear.
Status save_sequence(const Animation& animation, const std::string& path, const SaveOptions& options, WriteMesh write);

} // namespace meshreel::io
