/// Quake III models: several surfaces, key frames of 16-bit positions.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// All surfaces as one mesh, one after the other. Carried: "uv0" of vertices (v down), the surfaces' names as groups,
/// each surface's first shader as its material. Triangles are clockwise seen from outside, as in the file.
/// @fails bad_input: by byte; usage: a clip is asked for, but the format names none. @cost O(F V)
Result<Animation> parse_md3(ByteView bytes, const LoadOptions& options);

Result<Animation> load_md3(const std::string& path, const LoadOptions& options);

} // namespace meshreel::io
