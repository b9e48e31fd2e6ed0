/// The hole that a vertex leaves, and the ears that close it: by connectivity alone.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshreel/connectivity/stars.h"

namespace meshreel::connectivity {

constexpr std::size_t largest_ring = 24; ///< a vertex with more neighbours stays

using Edge = std::pair<std::uint32_t, std::uint32_t>; ///< smaller vertex first

/// What a vertex leaves. Memory is reused from hole to hole.
struct Hole {
    bool closed = true; ///< a ring of neighbours; otherwise a path along the boundary
    std::vector<std::uint32_t>
        ring; ///< the neighbours in turn, 2 .. largest_ring; a closed one from its lowest index on
    std::vector<Triangle> triangles; ///< what closes the hole, oriented like what was removed
    std::vector<Edge> claims; ///< edges that no two holes may share: those made, or one that tells it from others
};

/// A triangle list with its stars.
struct Mesh {
    std::span<const Triangle> triangles;
    const Stars& stars;
};

/// The hole of v. False if v must stay: its triangles are not one disc or one fan, agreeing in orientation; it has
/// more than largest_ring neighbours; or every way of closing the hole makes an edge or triangle that is there already.
///
/// An ear is the tip where degree(tip) - degree(left) - degree(right) is largest, of those whose edge left-right is
/// new; the lowest index among equals. A path is closed by an edge between its ends.
/// @cost O(n^2) for n neighbours.  @source thesis 8.2.1, (8.3)
bool find_hole(const Mesh& mesh, std::uint32_t v, Hole& hole);

} // namespace meshreel::connectivity
