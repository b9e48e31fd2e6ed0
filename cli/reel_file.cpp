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
    MESHREEL_TRY(const Bytes bytes, read_file(source.path, source.limits));
    DecodeOptions options;
    options.base = source.base.empty() ? nullptr : &base;
    options.limits = source.limits;
    options.threads = source.threads;
    options.progress = console.progress();
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
