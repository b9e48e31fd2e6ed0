/// The codec seen as a file format.
// SPDX-License-Identifier: MIT
#include "cli/reel_file.h"

#include "meshreel/base/file.h"
#include "meshreel/io/streamed_frames.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

/// The frames of a .reel file, and the file.
class OpenReel : public FrameSource {
public:
    OpenReel(FileSource file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}

    Status open(const Source& source, Console& console)
    {
        MESHREEL_TRY(base_, load_base(source, console));
        DecodeOptions options;
        options.base = source.base.empty() ? nullptr : &base_;
        options.limits = source.limits;
        options.threads = source.threads;
        MESHREEL_TRY(frames_, in_file(open_frames(file_, options), path_));
        return Ok{};
    }
    const Animation& still() const override { return frames_->still(); }
    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override
    {
        return in_file(frames_->frames(first, count, room), path_);
    }

private:
    FileSource file_;
    std::string path_;
    Animation base_;
    std::unique_ptr<FrameSource> frames_;
};

} // namespace

Result<Animation> load_base(const Source& source, Console& console)
{
    if (source.base.empty()) return Animation{};
    Source base;
    base.path = source.base;
    base.limits = source.limits;
    base.threads = source.threads;
    return load(base, console);
}

Result<Animation> load_reel(const Source& source, Console& console)
{
    MESHREEL_TRY(const Animation base, load_base(source, console));
    DecodeOptions options;
    options.base = source.base.empty() ? nullptr : &base;
    options.limits = source.limits;
    options.threads = source.threads;
    options.progress = console.progress();
    options.frames = source.frames;
    if (source.fps > 0.0) options.fps = source.fps;
    options.level = source.level;
    const bool some = source.level > 0 || source.frames.first > 0 || source.frames.last != io::FrameRange{}.last;
    if (some && !source.verify_all && is_regular_file(source.path)) {
        MESHREEL_TRY(FileSource file, FileSource::open(source.path));
        return in_file(decode(file, options), source.path);
    }
    MESHREEL_TRY(const Bytes bytes, read_file(source.path, source.limits));
    return in_file(decode(bytes, options), source.path);
}

Result<std::unique_ptr<FrameSource>> open_reel(const Source& source, Console& console)
{
    if (!source.as_stored() || !is_regular_file(source.path)) {
        MESHREEL_TRY(Animation animation, load(source, console));
        return std::unique_ptr<FrameSource>(std::make_unique<io::OwnedFrames>(std::move(animation)));
    }
    MESHREEL_TRY(FileSource file, FileSource::open(source.path));
    auto reel = std::make_unique<OpenReel>(std::move(file), source.path);
    MESHREEL_CHECK(reel->open(source, console));
    return std::unique_ptr<FrameSource>(std::move(reel));
}

Status save_reel(const Animation& animation, const Target& target, Console& console)
{
    EncodeOptions options;
    options.progress = console.progress();
    MESHREEL_CHECK(in_file(validate(animation), target.path));
    HeldFrames frames(animation);
    const Result<Reached> reached = in_file(save_encoded(frames, options, target), target.path);
    return reached.ok() ? Status(Ok{}) : reached.error();
}

} // namespace meshreel::cli
