/// How far a point is from a tetrahedron, both in four dimensions.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "meshreel/metrics/point4.h"

namespace meshreel::metrics {

/// Squared distance of a point to a tetrahedron, which may be flat, a segment or a point. Exactly 0 at a corner; never
/// below that of the nearest point by more than rounding. Where it is `bound` or more, any number that is so, too: most
/// tetrahedra are out of the question after a third of the work.  @source thesis 7.1.1
double squared_distance_to_tetrahedron(const Point4& point, const std::array<Point4, 4>& corners,
                                       double bound = std::numeric_limits<double>::infinity());

} // namespace meshreel::metrics
