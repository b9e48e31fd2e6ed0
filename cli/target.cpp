/// Checks an output before the work, and writes it after.
// SPDX-License-Identifier: MIT
#include "cli/target.h"

#include <filesystem>
#include <optional>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "cli/interrupt.h"
#include "cli/numbers.h"
#include "cli/reel_file.h"
#include "meshreel/base/file.h"
#include "meshreel/io/pattern.h"

namespace meshreel::cli {

namespace {

namespace fs = std::filesystem;

Error no_target(std::string message, std::string file)
{
    return {ErrorCode::usage, std::move(message), {}, std::move(file)};
}

/// A regular file of that name, or a file of that sequence, is there already: its name, or nothing.
Result<std::string> existing(const std::string& path)
{
    std::error_code ignored;
    MESHREEL_TRY(const std::optional<io::Pattern> pattern, io::parse_pattern(path));
    if (!pattern) return fs::is_regular_file(path, ignored) ? path : std::string{};
    const Result<std::vector<io::FrameFile>> files = io::list_files(*pattern);
    return files.ok() && !files->empty() ? files->front().path : std::string{};
}

bool same_file(const std::string& a, const std::string& b)
{
    if (a.empty() || b.empty() || a == "-" || b == "-") return false;
    std::error_code problem;
    const bool device = fs::exists(a, problem) && !fs::is_regular_file(a, problem);
    if (device) return false;
    if (fs::equivalent(a, b, problem)) return true;
    return fs::weakly_canonical(a, problem) == fs::weakly_canonical(b, problem);
}

Status check_folder(const std::string& path)
{
    std::error_code ignored;
    const fs::path folder = fs::path(path).parent_path();
    if (fs::is_directory(path, ignored)) return Error{ErrorCode::io, "is a folder, not a file", {}, path};
    if (folder.empty() || fs::is_directory(folder, ignored)) return Ok{};
    return Error{ErrorCode::io, fmt::format("cannot write: there is no folder {}", folder.string()), {}, path};
}

Status check_standard_output(const Target& target, const Console& console)
{
    if (console.json) return no_target("--json needs standard output, where the data go already", "-");
    if (::isatty(STDOUT_FILENO) != 0)
        return no_target("will not write data to a terminal; redirect it or name a file", "-");
    if (target.format_name().empty())
        return no_target("standard output has no extension; say its format by --format", "-");
    return Ok{};
}

/// The checks of one output path. @return Go::skip: it exists and may stay.
Result<Go> prepare_path(const Target& target, const std::string& path, std::initializer_list<std::string> inputs)
{
    for (const std::string& input : inputs)
        if (same_file(path, input)) return no_target("is the input too; give the output another name", path);
    MESHREEL_TRY(const std::string there, existing(path));
    if (!there.empty() && target.skip_existing) return Go::skip;
    if (!there.empty() && !target.overwrite)
        return no_target("exists already; pass -y to overwrite it, or --skip-existing to leave it", there);
    MESHREEL_CHECK(check_folder(path));
    expect_output_beside(path);
    return Go::on;
}

io::SaveOptions save_options(const Target& target, Console& console)
{
    io::SaveOptions options;
    options.overwrite = target.overwrite;
    options.morphs = target.morphs == "pca" ? io::Morphs::pca : io::Morphs::frames;
    options.bases = target.morph_bases;
    options.binary = !target.ascii;
    options.progress = console.progress();
    options.warn = [&console](const std::string& text) { console.warn(text); };
    return options;
}

Status save_animation(const Animation& animation, const Target& target, Console& console)
{
    const std::string name = target.format_name();
    if (name == "reel") return save_reel(animation, target, console);
    const io::SaveOptions options = save_options(target, console);
    const io::Format* const format = target.format.empty() ? nullptr : format_called(target.format);
    if (format == nullptr) return in_file(io::save(animation, target.path, options), target.path);
    if (format->save == nullptr)
        return in_file(Status(unsupported(fmt::format("{} cannot be written", name))), target.path);
    return in_file(format->save(animation, target.path, options), target.path);
}

/// The first frame alone.
Animation first_frame(const Animation& animation)
{
    Animation mesh;
    mesh.vertex_count = animation.vertex_count;
    mesh.triangles = animation.triangles;
    const auto frame = animation.frame(0);
    mesh.positions.assign(frame.begin(), frame.end());
    mesh.times_s = {animation.times_s.front()};
    mesh.appearance = animation.appearance;
    mesh.meta = animation.meta;
    return mesh;
}

/// Saves a mesh, where one is wanted, and then the rest; where that fails, what the mesh replaced is there again.
Status save_beside_mesh(const Target& target, const auto& make_mesh, const auto& save_rest)
{
    if (target.mesh_out.empty()) return save_rest();
    MESHREEL_TRY(Former former, in_file(Former::keep(target.mesh_out), target.mesh_out));
    MESHREEL_TRY(const Animation mesh, make_mesh());
    io::SaveOptions options;
    options.overwrite = target.overwrite;
    MESHREEL_CHECK(in_file(io::save(mesh, target.mesh_out, options), target.mesh_out));
    Status saved = save_rest();
    if (!saved.ok()) former.bring_back();
    return saved;
}

} // namespace

void Target::declare_overwriting(CLI::App& app)
{
    auto* const yes = app.add_flag("-y,--yes", overwrite, "overwrite files that exist")->group("Output");
    app.add_flag("--skip-existing", skip_existing, "do nothing where the output exists")
        ->group("Output")
        ->excludes(yes);
}

void Target::declare(CLI::App& app)
{
    declare_overwriting(app);
    app.add_option("--mesh-out", mesh_out, "also write the first frame as a mesh, for point caches")
        ->type_name("FILE")
        ->group("Output");
    app.add_option("--morphs", morphs, "glTF: one morph target a frame, or principal components as targets")
        ->check(one_of({"frames", "pca"}))
        ->type_name("frames|pca")
        ->group("Output");
    app.add_option("--morph-bases", morph_bases,
                   "targets of --morphs pca; default: as many as 0.01 % of the diagonal needs")
        ->check(positive())
        ->type_name("K")
        ->group("Output");
    app.add_flag("--ascii", ascii, "PLY as text")->group("Output");
}

std::string Target::format_name() const
{
    Source same_path;
    same_path.path = path;
    same_path.format = format;
    return same_path.format_name();
}

Result<Go> prepare(const Target& target, std::initializer_list<std::string> inputs, const Console& console)
{
    if (target.path == "-") MESHREEL_CHECK(check_standard_output(target, console));
    if (target.path != "-" && target.format.empty()) MESHREEL_CHECK(check_extension(target.path));
    MESHREEL_TRY(const Go go, prepare_path(target, target.path, inputs));
    if (go == Go::skip || target.mesh_out.empty()) return go;
    if (same_file(target.path, target.mesh_out)) return no_target("is named twice as output", target.mesh_out);
    return prepare_path(target, target.mesh_out, inputs);
}

Status save(const Animation& animation, const Target& target, Console& console)
{
    const Stopwatch watch;
    Status saved = save_beside_mesh(
        target, [&] { return Result<Animation>(first_frame(animation)); },
        [&] { return save_animation(animation, target, console); });
    if (saved.ok()) console.detail(fmt::format("{}: written in {:.3f} s", target.path, watch.seconds()));
    return saved;
}

bool takes_frames(const Target& target)
{
    const io::Format* const format = format_called(target.format_name());
    return format != nullptr && format->save_frames != nullptr;
}

Status save(FrameSource& frames, const Target& target, Console& console)
{
    const auto mesh_of = [&]() -> Result<Animation> {
        Matrix<float> room;
        MESHREEL_TRY(const MatrixView<const float> first, frames.frames(0, 1, room));
        Animation mesh = frames.still();
        mesh.positions.assign(first.values().begin(), first.values().end());
        mesh.times_s.resize(1);
        return mesh;
    };
    return save_beside_mesh(target, mesh_of, [&] {
        const io::Format* const format = format_called(target.format_name());
        return in_file(format->save_frames(frames, target.path, save_options(target, console)), target.path);
    });
}

Result<Reached> save_encoded(FrameSource& frames, const EncodeOptions& options, const Target& target)
{
    MESHREEL_TRY(AtomicFile file, in_file(AtomicFile::create(target.path, target.overwrite), target.path));
    MemorySpool held;
    Spool& spool = file.reads_back() ? static_cast<Spool&>(file) : held;
    MESHREEL_TRY(const Reached reached, encode(frames, spool, options));
    if (!file.reads_back()) MESHREEL_CHECK(in_file(file.write(std::move(held).take()), target.path));
    MESHREEL_CHECK(in_file(file.commit(), target.path));
    return reached;
}

Status save_bytes(ByteView bytes, const Target& target)
{
    return in_file(write_file(target.path, bytes, target.overwrite), target.path);
}

} // namespace meshreel::cli
