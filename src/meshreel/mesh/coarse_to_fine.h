/// Points from coarse to fine: levels of ever closer spacing, and for each point its nearest ones of earlier levels.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"

namespace meshreel {

/// An order of N points in which every prefix is spread over all of them.
struct CoarseToFine {
    static constexpr std::uint32_t nobody = 0xffffffff;

    std::vector<std::uint32_t> order; ///< [N] points, level after level, rising within a level
    std::vector<std::size_t> ends;    ///< [levels] where each level ends in the order; levels may be empty
    Matrix<std::uint32_t> nearest;    ///< [N x n] the nearest points of earlier levels, in no order, then nobody
};

/// Spreads points X [N x 3]. Level l takes, by rising number, every point left whose distance to all points taken so far
/// is at least half the diagonal of the bounding box over 1.1^l; the last level takes the rest. Whatever is not finite
/// counts as 0. n: nearest points wanted of each. The same result on every machine and for any number of threads.
/// Of points equally near those count as nearer that come first in the order.
/// @cost O(n N) for surfaces; memory 4 n N + 160 N bytes.
CoarseToFine coarse_to_fine(MatrixView<const double> X, std::size_t n, Threads threads);

} // namespace meshreel
