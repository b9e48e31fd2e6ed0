/// Which vertices an encoder takes away: the best predicted first, where the surface stays in shape.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "meshreel/connectivity/hole.h"
#include "meshreel/connectivity/surface.h"

namespace meshreel::connectivity {

struct PlanOptions {
    double coarse = 0.2;          ///< levels go on until fewer than this fraction of the vertices is left, [0, 1]
    double considered = 0.8;      ///< fraction of the priority queue that is considered at all, [0, 1]
    double sharpest_angle = 0.05; ///< no new triangle has a corner below this, radians
    double dearest = std::numeric_limits<double>::infinity(); ///< whose removal costs more stays for this level
};

/// What it costs that v goes and leaves this hole: how badly it is predicted from its ring, say. May depend on triangles
/// of v and of its neighbours, and on nothing else of the mesh.
using RemovalCost = std::function<double(const Mesh& mesh, std::uint32_t v, const Hole& hole)>;

/// What a plan decides.
struct Plan {
    int levels = 0;
    std::vector<std::uint8_t> level; ///< [W] at which each vertex goes, 1 .. levels; 0: stays
};

/// Level after level: evaluates the cost of every vertex that may go and has seen a change, then takes the cheapest first
/// and locks its neighbours. A vertex stays for this level if a new triangle would face away from the mean normal of those it
/// replaces, or be too sharp, in the first frame.
/// first_frame: [3W]; empty: no such check.
/// @cost O(levels (W + T)) and three costs a vertex or so.  @source thesis 8.2, 8.2.1
Plan plan_decimation(const Surface& surface, std::span<const float> first_frame, const RemovalCost& cost,
                     const PlanOptions& options = {});

} // namespace meshreel::connectivity
