/// Original, distorted and error side by side from several angles, as one PNG.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cli/pictures/surfaces.h"
#include "meshreel/base/result.h"

namespace meshreel::cli {

struct StripOptions {
    std::size_t views = 4;           ///< columns: the object has turned by 360 / views degrees from one to the next
    std::vector<std::size_t> frames; ///< of each column, [views]
    std::size_t panel_width = 300;   ///< pixels of a column
};

/// The bytes of a PNG. @pre the heat keeps the frames. @fails as the frames do; runtime: no PNG can be made.
Result<Bytes> turntable_strip(const Surfaces& surfaces, const StripOptions& options);

} // namespace meshreel::cli
