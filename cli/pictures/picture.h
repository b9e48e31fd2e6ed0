/// A picture that compares two animations: a few frames, original above decoded above the error as colour.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "meshreel/base/result.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

struct PictureOptions {
    std::size_t frames = 4;            ///< columns, 1 or more; spread over the animation
    std::size_t panel_width = 260;     ///< pixels of a column
    Axis up = Axis::unknown;           ///< unknown: as the animation says, else y
    std::string title = {};            ///< over the picture; may be empty
    std::string original = "original"; ///< caption of the first row; "\n" starts a new line
    std::string decoded = "decoded";   ///< caption of the second row
};

/// An SVG with its panels as PNG inside. Both animations have the same V, F and triangles (see metrics::comparable).
/// @fails runtime: a panel cannot be compressed.
Result<std::string> comparison_picture(const Animation& original, const Animation& decoded,
                                       const PictureOptions& options);

} // namespace meshreel::cli
