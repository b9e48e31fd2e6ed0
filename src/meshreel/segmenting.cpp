/// Segments of a length asked for.
// SPDX-License-Identifier: MIT
#include "meshreel/segmenting.h"

namespace meshreel {

std::vector<FrameSpan> equal_segments(std::size_t F, std::size_t longest)
{
    const std::size_t count = F / longest + (F % longest != 0);
    std::vector<FrameSpan> segments;
    for (std::size_t s = 0; s < count; ++s) segments.push_back({F * s / count, F * (s + 1) / count - F * s / count});
    return segments;
}

} // namespace meshreel
