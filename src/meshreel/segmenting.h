/// Where a long animation is cut.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace meshreel {

/// Frames first .. first + count - 1.
struct FrameSpan {
    std::size_t first = 0, count = 0;
};

/// As few segments as the longest allows, of nearly equal length. @pre F, longest >= 1
std::vector<FrameSpan> equal_segments(std::size_t F, std::size_t longest);

} // namespace meshreel
