/// Fewer vertices, with triangles of their own between them.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/distort/distortion.h"

namespace meshreel::distort {

/// Keeps request.amount of the vertices (of those with equal trajectories one counts), one at least: spread evenly over the first frame, bit for bit
/// where they were in every frame, and joined as mesh/coarse_surface.h does. The same bytes on every machine.
Result<Animation> simplification(const Animation& animation, const Request& request);

} // namespace meshreel::distort
