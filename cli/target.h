/// An animation named on the command line as output, with the options that say how to write it.
// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/console.h"
#include "cli/source.h"
#include "meshreel/io/io.h"
#include "meshreel/mesh/animation.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

/// Where an animation goes: a file, a sequence, or "-".
struct Target {
    std::string path;
    std::string format;   ///< a format's name or "reel", where the path's extension does not say it
    std::string mesh_out; ///< also writes the first frame here, for point caches; may be empty
    std::string morphs = "frames";
    std::uint32_t morph_bases = 0;
    bool ascii = false;
    bool overwrite = false;
    bool skip_existing = false;

    /// -y and --skip-existing.
    void declare_overwriting(CLI::App& app);
    /// Those, --mesh-out, --morphs, --morph-bases and --ascii.
    void declare(CLI::App& app);
    /// "reel", "obj", ...; empty where nothing says it.
    std::string format_name() const;
};

/// Whether to go on, before any long work.
enum class Go { on, skip };

/// Refuses to overwrite without -y, to write over one of `inputs`, to write into a folder that is not there, and to mix
/// bytes and JSON on standard output. Says skip where the output exists and --skip-existing was given.
/// @fails usage, io.
Result<Go> prepare(const Target& target, std::initializer_list<std::string> inputs, const Console& console);

/// Writes an animation in any format; nothing is left behind where it fails.
Status save(const Animation& animation, const Target& target, Console& console);
/// Whether its format is written frame by frame.
bool takes_frames(const Target& target);
/// The same of frames that are asked for one after the other. @pre takes_frames(target)
Status save(FrameSource& frames, const Target& target, Console& console);

/// Encodes into a .reel file, which appears when it is whole.
Result<Reached> save_encoded(FrameSource& frames, const EncodeOptions& options, const Target& target);

/// Bytes to a file or to standard output, but not to a terminal.
Status save_bytes(ByteView bytes, const Target& target);

} // namespace meshreel::cli
