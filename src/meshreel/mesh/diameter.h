/// The largest distance between two points of a set, exactly.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/views.h"

namespace meshreel {

/// The largest distance between two rows of points, [N x 3]; 0 for fewer than two. To the bit what comparing all pairs
/// in double precision gives; any input: planar, collinear, doubled, a single point.
/// Points that cannot be an end are dropped first, then two boxes of points are compared only while some pair of them
/// may still be farther apart than the best pair found.
/// @cost O(N log N) for bodies; about N^1.4 for points on a sphere, where nearly all pairs nearly tie.  @source thesis (7.9)
double largest_distance(MatrixView<const float> points);
double largest_distance(MatrixView<const double> points);

} // namespace meshreel
