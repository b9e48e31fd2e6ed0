/// The order in which codecs meet the vertices: the Edgebreaker traversal over any triangle list.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "meshreel/connectivity/surface.h"

namespace meshreel::connectivity {

/// Walks every component from its first triangle in the list, to the right whenever there is a choice. The same list
/// gives the same trace on every machine, so whoever has the list needs no order sent.
///
/// Holes, non-manifold edges and places where the orientation cannot agree are simply not crossed; a vertex is met
/// once, whichever of its fans is first. In the first triangle of a component a new vertex's gate holds the
/// vertices of that triangle known so far. Isolated vertices come last, by number.
/// @param vertex_count W, above every index of triangles.
/// @cost O(W + T log of the largest degree), 60 bytes a triangle.  @source thesis 3.2.2
Trace trace(std::uint32_t vertex_count, std::span<const Triangle> triangles);

} // namespace meshreel::connectivity
