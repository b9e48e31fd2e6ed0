/// .reel files as one more format: read by decode(), written by encode() with its defaults.
// SPDX-License-Identifier: MIT
#pragma once

#include "cli/console.h"
#include "cli/source.h"
#include "cli/target.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

/// Decodes the frames and the level asked for of a .reel file; of a regular file only what they need is read, unless it is to be
/// verified. @fails usage: no such frame; io, bad_input, unsupported; naming the file.
Result<Animation> load_reel(const Source& source, Console& console);

/// The same, segment by segment, where all frames are asked for as they are stored; a file that is read once.
Result<std::unique_ptr<FrameSource>> open_reel(const Source& source, Console& console);

/// The base mesh that `source.base` names, or an empty animation where it names none.
Result<Animation> load_base(const Source& source, Console& console);

/// Encodes with every option at its default.
Status save_reel(const Animation& animation, const Target& target, Console& console);

} // namespace meshreel::cli
