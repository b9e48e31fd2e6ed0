/// The codec seen as a file format.
// SPDX-License-Identifier: MIT
#include "cli/reel_file.h"

#include "meshreel/base/file.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

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

Status save_reel(const Animation& animation, const Target& target, Console& console)
{
    EncodeOptions options;
    options.progress = console.progress();
    MESHREEL_TRY(const Encoded encoded, in_file(encode(animation, options), target.path));
    return save_bytes(encoded.bytes, target);
}

} // namespace meshreel::cli
