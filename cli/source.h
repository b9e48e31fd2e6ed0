/// An animation named on the command line as input, with the options that say how to read it.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/console.h"
#include "meshreel/base/limits.h"
#include "meshreel/base/parallel.h"
#include "meshreel/io/io.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

/// Where an animation comes from: a file, a sequence, or "-".
struct Source {
    std::string path;
    std::string format; ///< a format's name or "reel", where the path's extension does not say it
    std::string mesh;   ///< the mesh of a point cache
    std::string base;   ///< the base mesh of a .reel file that has no connectivity
    std::string clip;
    double fps = 0.0; ///< 0: the file's
    io::FrameRange frames;
    std::uint32_t level = 0; ///< of detail, of a .reel file
    bool verify_all = false; ///< of a .reel file, also the parts that the frames do not need
    DecodeLimits limits;
    Threads threads;

    /// Declares every option but the path and the format.
    void declare(CLI::App& app);
    /// --threads and --max-memory alone.
    void declare_limits(CLI::App& app);
    /// "reel", "obj", ...; empty where nothing says it.
    std::string format_name() const;
    bool is_reel() const { return format_name() == "reel"; }
    /// Whether every frame is taken as it is stored.
    bool as_stored() const
    {
        return frames.first == 0 && frames.last == io::FrameRange{}.last && frames.step == 1 && fps == 0.0 &&
               level == 0;
    }
};

/// Declares an option that names a format: obj, glb, ..., reel.
void declare_format(CLI::App& app, const std::string& option, std::string& format, const std::string& help);

/// The row of the format of that name, or null.
const io::Format* format_called(const std::string& name);

/// Says that a path's extension names a format, .reel among them. @fails unsupported, listing what is known.
Status check_extension(const std::string& path);

/// Reads any animation; the result is valid. @fails as io::load and decode do, naming the file.
Result<Animation> load(const Source& source, Console& console);

/// The same, its frames read when they are asked for, where that is possible.
Result<std::unique_ptr<FrameSource>> open(const Source& source, Console& console);

} // namespace meshreel::cli
