/// Animations from files and into files: the registry of formats.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "meshreel/base/limits.h"
#include "meshreel/base/progress.h"
#include "meshreel/mesh/frame_source.h"

namespace meshreel::io {

/// Frames first, first + step, ... up to last (inclusive), by their place in the source.
struct FrameRange {
    std::uint64_t first = 0;
    std::uint64_t last = ~0ull;
    std::uint64_t step = 1; ///< >= 1
};

struct LoadOptions {
    std::string mesh; ///< the mesh of a point cache (PC2, MDD): a path of any mesh format
    std::string clip; ///< the clip of a file with several (glTF, MD2), by name; empty: the first (MD2: all frames)
    double fps = 0.0; ///< frames a second: the sampling rate of a baked file, the timing of a sequence; 0: the file's
    FrameRange frames;
    DecodeLimits limits;
    Progress progress;
    std::function<void(std::string)> warn; ///< told what the file holds and an Animation does not; may be empty
};

enum class Morphs : std::uint8_t {
    frames, ///< one morph target a frame
    pca     ///< K principal components as targets, an F x K weight track
};

struct SaveOptions {
    bool overwrite = false;
    Morphs morphs = Morphs::frames;
    std::uint32_t bases = 0; ///< K for Morphs::pca; 0: as many as an error of 0.01 % of the body diagonal needs
    bool binary = true;      ///< PLY
    Progress progress;
    std::function<void(std::string)> warn; ///< told what the animation holds and the file cannot; may be empty
};

/// One row of the registry. A format that cannot do a direction leaves its function null.
struct Format {
    std::string_view name;                        ///< "obj"
    std::span<const std::string_view> extensions; ///< lower case, without the dot
    std::string_view summary;                     ///< "Wavefront OBJ, one file a frame"
    Result<Animation> (*load)(const std::string& path, const LoadOptions& options);
    Status (*save)(const Animation& animation, const std::string& path, const SaveOptions& options);
    /// Null where files of this format are only read as a whole.
    Result<std::unique_ptr<FrameSource>> (*open)(const std::string& path, const LoadOptions& options) = nullptr;
    /// Null where an animation is only written as a whole.
    Status (*save_frames)(FrameSource& frames, const std::string& path, const SaveOptions& options) = nullptr;
};

/// Every format, in the order of the documentation.
std::span<const Format> formats();

/// The format that a path's extension names. @fails unsupported: no such format.
Result<const Format*> format_of(const std::string& path);

/// Reads an animation: a file, or a sequence ("walk.####.obj", "walk.%04d.obj", "walk.*.obj"; natural order).
/// The result is valid (see validate). @fails as the format says, always naming file and place.
Result<Animation> load(const std::string& path, const LoadOptions& options = {});

/// The same, read frame by frame when it is asked for, where the format and the file (a regular one) allow it: PC2, MDD,
/// and sequences of OBJ, PLY and OFF too large to hold. The files must stay as they are. @fails likewise.
Result<std::unique_ptr<FrameSource>> open(const std::string& path, const LoadOptions& options = {});
/// Of a format that is known.
Result<std::unique_ptr<FrameSource>> open(const Format& format, const std::string& path, const LoadOptions& options);

/// Writes an animation in the format that the path's extension names; a sequence pattern writes one file a frame.
/// Nothing is left behind where it fails.
Status save(const Animation& animation, const std::string& path, const SaveOptions& options = {});

} // namespace meshreel::io
