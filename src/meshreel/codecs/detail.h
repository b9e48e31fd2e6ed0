/// Levels of detail: how many vertices each keeps of an order from coarse to fine.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/mesh/coarse_to_fine.h"

namespace meshreel::codecs {

/// What a codec with levels of detail tells of a payload: who is kept, and where that is.
struct Detail {
    Matrix<double> places;            ///< [W x 3] of all vertices, of any scale
    std::vector<std::uint32_t> order; ///< [W] every level keeps the first so many of these
    std::vector<std::size_t> counts;  ///< [levels] so many, falling: level 0 keeps all

    std::span<const std::uint32_t> kept(std::size_t level) const { return std::span(order).first(counts[level]); }
};

/// Counts of the levels of detail, falling from all vertices: each the largest at which a level of the order ends and
/// that is at most a quarter of the one before, none below 24.
inline std::vector<std::size_t> detail_counts(const CoarseToFine& order)
{
    constexpr std::size_t least = 24;
    std::vector<std::size_t> counts{order.order.size()};
    for (std::size_t l = order.ends.size(); l-- > 0;)
        if (order.ends[l] >= least && order.ends[l] <= counts.back() / 4) counts.push_back(order.ends[l]);
    return counts;
}

} // namespace meshreel::codecs
