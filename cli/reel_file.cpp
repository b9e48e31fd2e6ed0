/// The codec seen as a file format.
// SPDX-License-Identifier: MIT
#include "cli/reel_file.h"

namespace meshreel::cli {

Result<Animation> load_reel(const Source& source, Console&)
{
    return in_file(Result<Animation>(unsupported(".reel files cannot be read by this version")), source.path);
}

Status save_reel(const Animation&, const Target& target, Console&)
{
    return in_file(Status(unsupported(".reel files cannot be written by this version")), target.path);
}

} // namespace meshreel::cli
