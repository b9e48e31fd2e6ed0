/// Frames from files of one mesh each, checked against the first.
// SPDX-License-Identifier: MIT
#include "meshreel/io/sequence.h"

#include <filesystem>
#include <set>
#include <utility>

#include "meshreel/base/text.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/pattern.h"
#include "meshreel/io/streamed_frames.h"

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

/// The files of a sequence, read one after the other.
class SequenceFrames : public StreamedFrames {
public:
    SequenceFrames(std::vector<FrameFile> files, const Selection& chosen, const LoadOptions& options,
                   const MeshFormat& format)
        : files_(std::move(files)), chosen_(chosen), format_(format), options_(options)
    {
        options_.warn = [this, warn = options.warn](std::string sentence) {
            if (warn && told_.insert(sentence).second) warn(file_ + ": " + sentence);
        };
    }
    SequenceFrames(const SequenceFrames&) = delete;
    SequenceFrames& operator=(const SequenceFrames&) = delete;

    /// Reads the first file. options: whose warnings do not name a file yet.
    Status begin(const LoadOptions& options);

private:
    Status read_frame(std::size_t i, std::span<float> positions) override;
    std::uint64_t number(std::size_t i) const override { return chosen_[i]; }
    const std::string& file(std::size_t i) const override { return files_[chosen_[i]].path; }

    Result<Animation> read_mesh(const std::string& path, std::uint64_t frame);
    Status check_like_first(const Animation& mesh, std::uint64_t frame);
    Status same_triangles(const Animation& mesh, std::uint64_t frame) const;
    void compare_attributes(const Animation& mesh);

    std::vector<FrameFile> files_;
    Selection chosen_;
    MeshFormat format_;
    LoadOptions options_;
    std::set<std::string> told_; ///< what one frame said the others need not repeat
    std::string file_;
    std::vector<float> first_positions_; ///< of the first frame, until it is asked for
};

Result<Animation> SequenceFrames::read_mesh(const std::string& path, std::uint64_t frame)
{
    file_ = path;
    MESHREEL_TRY(const Bytes bytes, read_file(path, options_.limits));
    MESHREEL_TRY(Animation mesh, in_file(format_.parse(bytes, options_), path));
    MESHREEL_CHECK(in_file(check_finite(mesh.positions, frame), path));
    return mesh;
}

Status SequenceFrames::same_triangles(const Animation& mesh, std::uint64_t frame) const
{
    const auto named = [](const Triangle& t) { return concat("(", t[0], " ", t[1], " ", t[2], ")"); };
    if (mesh.triangles.size() != still_.triangles.size())
        return bad_input(concat("frame ", frame, " has ", mesh.triangles.size(), " triangles, the first frame (",
                                file(0), ") has ", still_.triangles.size(), "; the connectivity must not change"),
                         "triangles");
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.triangles[t] != still_.triangles[t])
            return bad_input(concat("frame ", frame, ": triangle ", t, " is ", named(mesh.triangles[t]),
                                    ", in the first frame (", file(0), ") it is ", named(still_.triangles[t]),
                                    "; the connectivity must not change"),
                             "triangles");
    return Ok{};
}

void SequenceFrames::compare_attributes(const Animation& mesh)
{
    for (const Attribute& later : mesh.appearance.attributes)
        if (!still_.appearance.find(later.name))
            options_.warn(concat("the attribute ", later.name, " is not in the first frame, and is left out"));
    for (const Attribute& first : still_.appearance.attributes) {
        const Attribute* later = mesh.appearance.find(first.name);
        if (!later || later->values != first.values || later->indices != first.indices)
            options_.warn(concat("the attribute ", first.name, " differs from the first frame's, which is kept"));
    }
}

Status SequenceFrames::check_like_first(const Animation& mesh, std::uint64_t frame)
{
    if (mesh.vertex_count != still_.vertex_count)
        return bad_input(concat("frame ", frame, " has ", mesh.vertex_count, " vertices, the first frame (", file(0),
                                ") has ", still_.vertex_count),
                         "vertex_count");
    MESHREEL_CHECK(same_triangles(mesh, frame));
    compare_attributes(mesh);
    return Ok{};
}

Status SequenceFrames::begin(const LoadOptions& options)
{
    MESHREEL_TRY(still_, read_mesh(file(0), chosen_.first));
    MESHREEL_CHECK(in_file(within(options_.limits, still_.vertex_count, still_.triangles.size(), 1), file(0)));
    MESHREEL_CHECK(in_file(within(chosen_.count, options_.limits.max_frames, "frame_count"), file(0)));
    first_positions_ = std::exchange(still_.positions, {});
    give_times(still_, chosen_, options);
    if (format_.complete != nullptr) format_.complete(still_, file(0), options);
    return Ok{};
}

Status SequenceFrames::read_frame(std::size_t i, std::span<float> positions)
{
    if (i == 0 && !first_positions_.empty()) {
        std::ranges::copy(std::exchange(first_positions_, {}), positions.begin());
        return Ok{};
    }
    MESHREEL_TRY(const Animation mesh, read_mesh(file(i), chosen_[i]));
    MESHREEL_CHECK(check_like_first(mesh, chosen_[i]));
    std::ranges::copy(mesh.positions, positions.begin());
    return Ok{};
}

Result<std::unique_ptr<FrameSource>> streamed_sequence(const std::string& path, const LoadOptions& options,
                                                       const MeshFormat& format)
{
    MESHREEL_CHECK(check_fps(options));
    MESHREEL_TRY(std::vector<FrameFile> files, files_of(path, options));
    MESHREEL_TRY(const Selection chosen, in_file(select_frames(options.frames, files.size()), path));
    auto frames = std::make_unique<SequenceFrames>(std::move(files), chosen, options, format);
    MESHREEL_CHECK(frames->begin(options));
    return std::unique_ptr<FrameSource>(std::move(frames));
}

} // namespace

Result<Animation> load_sequence(const std::string& path, const LoadOptions& options, const MeshFormat& format)
{
    MESHREEL_TRY(const std::unique_ptr<FrameSource> frames, streamed_sequence(path, options, format));
    return gathered(*frames, options);
}

Result<std::unique_ptr<FrameSource>> open_sequence(const std::string& path, const LoadOptions& options,
                                                   const MeshFormat& format)
{
    MESHREEL_TRY(std::unique_ptr<FrameSource> frames, streamed_sequence(path, options, format));
    return held_if_small(std::move(frames), options);
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
