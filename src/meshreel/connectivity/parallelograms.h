/// All parallelograms that a vertex can complete when its turn comes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/connectivity/surface.h"

namespace meshreel::connectivity {

/// Two triangles that share the edge left-right; all three corners are earlier vertices than the tip.
struct Parallelogram {
    std::uint32_t left, right, opposite;
};

/// Parallelograms by their tip.
struct Parallelograms {
    std::vector<std::size_t> ends; ///< [W] where each tip's parallelograms end
    std::vector<Parallelogram> all;

    std::span<const Parallelogram> of(std::size_t tip) const
    {
        const std::size_t begin = tip == 0 ? 0 : ends[tip - 1];
        return std::span(all).subspan(begin, ends[tip] - begin);
    }
};

/// Every edge between exactly two triangles makes one, for the later of its two tips where that is later than the edge.
/// @cost O(W + T log of the largest degree).
Parallelograms parallelograms(const Surface& surface);

} // namespace meshreel::connectivity
