/// Frames from files of one mesh each, checked against the first.
// SPDX-License-Identifier: MIT
#include "meshreel/io/sequence.h"

#include <filesystem>
#include <set>

#include "meshreel/base/text.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/pattern.h"

namespace meshreel::io {

namespace {

Result<std::vector<FrameFile>> files_of(const std::string& path, const LoadOptions& options)
{
    std::error_code ignored;
    const std::vector<FrameFile> single{{path, 0}};
    if (std::filesystem::exists(path, ignored)) return single;
    MESHREEL_TRY(const auto pattern, parse_pattern(path));
    if (!pattern) return single;
    MESHREEL_TRY(const auto files, in_file(list_files(*pattern), path));
    for (std::size_t i = 1; i < files.size(); ++i) {
        const std::uint64_t from = files[i - 1].number + 1, to = files[i].number;
        if (from == to) continue;
        const std::string gap =
            from + 1 == to ? concat("number ", from, " is") : concat("numbers ", from, " to ", to - 1, " are");
        tell(options, concat(path, ": ", gap, " missing; the frames around the gap follow each other"));
    }
    return files;
}

/// Reads the files of a sequence one after the other.
class SequenceReader {
public:
    SequenceReader(const LoadOptions& options, ParseMesh parse) : parse_(parse), options_(options)
    {
        options_.warn = [this, warn = options.warn](std::string sentence) {
            if (warn && told_.insert(sentence).second) warn(file_ + ": " + sentence);
        };
    }
    SequenceReader(const SequenceReader&) = delete;
    SequenceReader& operator=(const SequenceReader&) = delete;

    Result<Animation> read(const std::vector<FrameFile>& files, const Selection& chosen);

private:
    Result<Animation> read_mesh(const std::string& path, std::uint64_t frame);
    Status append(const Animation& mesh, std::uint64_t frame);
    Status same_triangles(const Animation& mesh, std::uint64_t frame) const;
    void compare_attributes(const Animation& mesh);

    ParseMesh parse_;
    LoadOptions options_;
    std::set<std::string> told_; ///< what one frame said the others need not repeat
    std::string file_, first_file_;
    Animation all_;
};

Result<Animation> SequenceReader::read_mesh(const std::string& path, std::uint64_t frame)
{
    file_ = path;
    MESHREEL_TRY(const Bytes bytes, read_file(path, options_.limits));
    MESHREEL_TRY(Animation mesh, in_file(parse_(bytes, options_), path));
    MESHREEL_CHECK(in_file(check_finite(mesh.positions, frame), path));
    return mesh;
}

Status SequenceReader::same_triangles(const Animation& mesh, std::uint64_t frame) const
{
    const auto named = [](const Triangle& t) { return concat("(", t[0], " ", t[1], " ", t[2], ")"); };
    if (mesh.triangles.size() != all_.triangles.size())
        return bad_input(concat("frame ", frame, " has ", mesh.triangles.size(), " triangles, the first frame (",
                                first_file_, ") has ", all_.triangles.size(), "; the connectivity must not change"),
                         "triangles");
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.triangles[t] != all_.triangles[t])
            return bad_input(concat("frame ", frame, ": triangle ", t, " is ", named(mesh.triangles[t]),
                                    ", in the first frame (", first_file_, ") it is ", named(all_.triangles[t]),
                                    "; the connectivity must not change"),
                             "triangles");
    return Ok{};
}

void SequenceReader::compare_attributes(const Animation& mesh)
{
    for (const Attribute& later : mesh.appearance.attributes)
        if (!all_.appearance.find(later.name))
            options_.warn(concat("the attribute ", later.name, " is not in the first frame, and is left out"));
    for (const Attribute& first : all_.appearance.attributes) {
        const Attribute* later = mesh.appearance.find(first.name);
        if (!later || later->values != first.values || later->indices != first.indices)
            options_.warn(concat("the attribute ", first.name, " differs from the first frame's, which is kept"));
    }
}

Status SequenceReader::append(const Animation& mesh, std::uint64_t frame)
{
    if (mesh.vertex_count != all_.vertex_count)
        return bad_input(concat("frame ", frame, " has ", mesh.vertex_count, " vertices, the first frame (",
                                first_file_, ") has ", all_.vertex_count),
                         "vertex_count");
    MESHREEL_CHECK(same_triangles(mesh, frame));
    compare_attributes(mesh);
    all_.positions.insert(all_.positions.end(), mesh.positions.begin(), mesh.positions.end());
    return Ok{};
}

Result<Animation> SequenceReader::read(const std::vector<FrameFile>& files, const Selection& chosen)
{
    first_file_ = files[chosen.first].path;
    MESHREEL_TRY(all_, read_mesh(first_file_, chosen.first));
    MESHREEL_CHECK(
        in_file(within(options_.limits, all_.vertex_count, all_.triangles.size(), chosen.count), first_file_));
    all_.positions.reserve(all_.positions.size() * chosen.count);
    for (std::uint64_t i = 1; i < chosen.count; ++i) {
        report(options_.progress, "reading", static_cast<double>(i) / static_cast<double>(chosen.count));
        const FrameFile& file = files[chosen[i]];
        MESHREEL_TRY(const Animation mesh, read_mesh(file.path, chosen[i]));
        MESHREEL_CHECK(in_file(append(mesh, chosen[i]), file.path));
    }
    return std::move(all_);
}

} // namespace

Result<Animation> load_sequence(const std::string& path, const LoadOptions& options, ParseMesh parse)
{
    MESHREEL_CHECK(check_fps(options));
    MESHREEL_TRY(const std::vector<FrameFile> files, files_of(path, options));
    MESHREEL_TRY(const Selection chosen, in_file(select_frames(options.frames, files.size()), path));
    SequenceReader reader(options, parse);
    MESHREEL_TRY(Animation animation, reader.read(files, chosen));
    give_times(animation, chosen, options);
    return animation;
}

Result<std::string> first_file(const std::string& path, const LoadOptions& options)
{
    LoadOptions silent = options;
    silent.warn = nullptr;
    MESHREEL_TRY(const std::vector<FrameFile> files, files_of(path, silent));
    MESHREEL_TRY(const Selection chosen, in_file(select_frames(options.frames, files.size()), path));
    return files[chosen.first].path;
}

Status add_sequence(FileSet& files, const Animation& animation, const SequenceTarget& target,
                    const SaveOptions& options)
{
    const std::string& path = target.path;
    MESHREEL_TRY(const auto pattern, parse_pattern(path));
    const std::size_t frames = animation.frame_count();
    if (pattern ? !pattern->digits : frames != 1)
        return Error{
            ErrorCode::usage,
            concat(frames,
                   " frames need a file each: write a number into the name, as in walk.####.obj or walk.%04d.obj"),
            {},
            path,
            {}};
    for (std::size_t f = 0; f < frames; ++f) {
        report(options.progress, "writing", static_cast<double>(f) / static_cast<double>(frames));
        MESHREEL_TRY(const Bytes bytes, in_file(target.write(animation, f, options), path));
        MESHREEL_CHECK(files.add(pattern ? pattern->path(f) : path, bytes));
    }
    return Ok{};
}

Status save_sequence(const Animation& animation, const std::string& path, const SaveOptions& options, WriteMesh write)
{
    FileSet files(options.overwrite);
    MESHREEL_CHECK(add_sequence(files, animation, {path, write}, options));
    return files.commit();
}

} // namespace meshreel::io
