/// Dispatches .reel files to the codec and everything else to the formats.
// SPDX-License-Identifier: MIT
#include "cli/source.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/reel_file.h"
#include "meshreel/io/streamed_frames.h"

namespace meshreel::cli {

namespace {

io::LoadOptions load_options(const Source& source, Console& console)
{
    io::LoadOptions options;
    options.mesh = source.mesh;
    options.clip = source.clip;
    options.fps = source.fps;
    options.frames = source.frames;
    options.limits = source.limits;
    options.progress = console.progress();
    options.warn = [&console](const std::string& text) { console.warn(text); };
    return options;
}

/// A format asked for by name reads whatever it is given, standard input too.
Result<Animation> load_as(const io::Format& format, const Source& source, const io::LoadOptions& options)
{
    if (format.load == nullptr)
        return in_file(Result<Animation>(unsupported(fmt::format("{} cannot be read", format.name))), source.path);
    MESHREEL_TRY(Animation animation, in_file(format.load(source.path, options), source.path));
    MESHREEL_CHECK(in_file(validate(animation), source.path));
    return animation;
}

Result<Animation> load_any(const Source& source, Console& console)
{
    if (source.is_reel()) return load_reel(source, console);
    if (source.path == "-" && source.format.empty())
        return Error{ErrorCode::usage, "standard input has no extension; say its format by --format", {}, "-"};
    if (source.format.empty()) MESHREEL_CHECK(check_extension(source.path));
    const io::LoadOptions options = load_options(source, console);
    const io::Format* const format = source.format.empty() ? nullptr : format_called(source.format);
    if (format != nullptr) return load_as(*format, source, options);
    return in_file(io::load(source.path, options), source.path);
}

} // namespace

void Source::declare(CLI::App& app)
{
    app.add_option("--mesh", mesh, "the mesh of a point cache (.pc2, .mdd)")->type_name("FILE");
    app.add_option("--base", base, "the base mesh of a .reel file made with --base")->type_name("FILE");
    app.add_option("--clip", clip, "the clip to take of a file with several; default: the first")->type_name("NAME");
    app.add_option("--fps", fps, "frames a second: sampling rate of a skinned or .reel file, timing of a sequence")
        ->check(positive())
        ->type_name("N");
    add_parsed(app, {"--frames", "frames to take, from 0, the last included"}, frames, parse_frames)
        ->type_name("A:B:STEP");
    declare_limits(app);
}

void Source::declare_limits(CLI::App& app)
{
    app.add_option("--threads", threads.count, "threads to use; default: one a core")->type_name("N");
    add_parsed(app, {"--max-memory", "memory that a file may make us hold; default 16G"}, limits.max_memory,
               parse_memory)
        ->type_name("SIZE");
    app.add_option("--max-expansion", limits.max_expansion,
                   "bytes that a byte of a .reel file may become, beyond 64 MiB; default 1000000")
        ->type_name("N");
    app.add_option("--max-work", limits.max_work,
                   "multiplications that a byte of a .reel or glTF file may cause, beyond 256 a coordinate or pose; "
                   "default 4000000")
        ->type_name("N");
}

std::string Source::format_name() const
{
    if (!format.empty()) return format;
    std::string extension = std::filesystem::path(path).extension().string();
    if (extension.empty()) return {};
    extension.erase(0, 1);
    for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (extension == "reel") return extension;
    for (const io::Format& row : io::formats())
        if (std::find(row.extensions.begin(), row.extensions.end(), extension) != row.extensions.end())
            return std::string(row.name);
    return {};
}

void declare_format(CLI::App& app, const std::string& option, std::string& format, const std::string& help)
{
    std::vector<std::string> names{"reel"};
    for (const io::Format& row : io::formats()) names.emplace_back(row.name);
    app.add_option(option, format, fmt::format("{}: {}", help, fmt::join(names, ", ")))
        ->check(one_of(names))
        ->type_name("NAME");
}

const io::Format* format_called(const std::string& name)
{
    for (const io::Format& row : io::formats())
        if (row.name == name) return &row;
    return nullptr;
}

Status check_extension(const std::string& path)
{
    Source named;
    named.path = path;
    if (!named.format_name().empty()) return Ok{};
    std::string known = ".reel";
    for (const io::Format& row : io::formats())
        for (const std::string_view extension : row.extensions) known += fmt::format(" .{}", extension);
    return Error{ErrorCode::unsupported, fmt::format("no format has this extension; known are {}", known), {}, path};
}

Result<Animation> load(const Source& source, Console& console)
{
    const Stopwatch watch;
    Result<Animation> animation = load_any(source, console);
    if (animation.ok())
        console.detail(fmt::format("{}: read in {:.3f} s: {}", source.path, watch.seconds(), counts_text(*animation)));
    return animation;
}

Result<std::unique_ptr<FrameSource>> open(const Source& source, Console& console)
{
    if (source.is_reel() || source.path == "-") {
        MESHREEL_TRY(Animation animation, load(source, console));
        return std::unique_ptr<FrameSource>(std::make_unique<io::OwnedFrames>(std::move(animation)));
    }
    if (source.format.empty()) MESHREEL_CHECK(check_extension(source.path));
    const io::LoadOptions options = load_options(source, console);
    const io::Format* const format = source.format.empty() ? nullptr : format_called(source.format);
    return in_file(format != nullptr ? io::open(*format, source.path, options) : io::open(source.path, options),
                   source.path);
}

} // namespace meshreel::cli
