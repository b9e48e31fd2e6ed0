/// Certified bounds of the one-sided Hausdorff distance between two surfaces.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/metrics/surface_distance.h"

namespace meshreel::metrics {

/// One frame of a surface and the tree of it.
struct SurfaceFrame {
    std::span<const Triangle> triangles; ///< [T]
    std::span<const float> positions;    ///< [V x 3]
    const SurfaceDistance& tree;         ///< of these triangles and positions
};

struct BoundOptions {
    double tolerance = 0.0;          ///< upper - lower is at most this, model units, >= 0 ...
    std::size_t most_cuts = 2000000; ///< ... unless more cuts than these were needed
    bool same_triangles = false;     ///< triangle t of one is likely near triangle t of the other
    std::span<double> vertices = {}; ///< [V] or empty: is filled with the distance of every vertex, model units
};

/// What is known about max over p of `from` of d(p, to), (5.16). Both bounds are true up to the rounding of doubles (some
/// 1e-15 of the coordinates).
struct DistanceBounds {
    double lower = 0.0;   ///< found at a point of the surface, model units
    double upper = 0.0;   ///< no point of the surface is farther away
    std::size_t cuts = 0; ///< work done
};

/// Bounds the one-sided distance (5.16) by branch and bound.
///
/// A triangle is a convex set and the distance to a convex set is a convex function: for one triangle t of the other
/// surface, no point of a convex piece is farther from t than the farthest of the piece's corners. So
///
///     max over corners of d(corner, to)  <=  max over the piece of d(p, to)  <=  min over t of max over corners of d(corner, t)
///
/// where t need not go over more than the triangles that are nearest to the corners. The piece with the largest upper
/// bound is cut first, along the plane that separates its nearest triangles where there is one: once the same triangle is
/// nearest to all corners of a piece, both bounds of it are equal.
///
/// The vertices of a surface without triangles are not looked at here. @pre `to` is not empty
/// @cost O(T log T), and some cuts where the bounds are not decided by whole triangles
DistanceBounds bound_distance(const SurfaceFrame& from, const SurfaceDistance& to, const BoundOptions& options);

} // namespace meshreel::metrics
