/// The Hausdorff distance of two animations in space-time, whatever their vertices, triangles, frames and times.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "meshreel/base/parallel.h"
#include "meshreel/base/progress.h"
#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"
#include "meshreel/mesh/space_time.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/space_time_grid.h"

namespace meshreel::metrics {

/// What is asked of the 4D Hausdorff distance.
struct Hausdorff4dOptions {
    double time_constant = usual_time_constant; ///< alpha, body diagonals a second, > 0
    double samples = 0.5; ///< points a triangle and interval, spread evenly over the tetrahedra; 0: the vertices alone
    std::uint64_t seed = 1; ///< another seed, other points
    Threads threads = {};
};

/// Who wants to see what; both may be empty.
struct Hausdorff4dWatch {
    /// Distances of the original's vertices in a frame, [V], body diagonals; frame after frame. 0 for a vertex in no triangle.
    VertexErrors vertex_errors;
    Progress progress;
};

/// An animation whose positions are apart from the rest of it.
struct MovingMesh {
    const Animation& still;         ///< V, triangles, times
    MatrixView<const float> frames; ///< [F x 3V]
};

/// Largest, mean and root mean square of some distances, body diagonals of the original's first frame (model units where
/// that has no extent).
struct DistanceSpread {
    double largest = 0.0, mean = 0.0, rms = 0.0;
};

/// From one animation to the other.
struct Directed4d {
    DistanceSpread vertices; ///< of every vertex of a triangle, in every frame
    DistanceSpread samples;  ///< of points spread evenly; 0 where there are none
    bool sampled = false;    ///< whether there are any
    double upper = 0.0;      ///< no point of the animation is farther
    GridCost cost;           ///< of the grid over the other one

    /// A distance that some point has: the Hausdorff distance in this direction is between this and `upper`.
    double lower() const { return vertices.largest > samples.largest ? vertices.largest : samples.largest; }
    /// lower(), and the mean and root mean square of the samples; where there are none, of the vertices.
    DistanceSpread spread() const;
};

struct Hausdorff4d {
    Directed4d forward;  ///< from the original to the distorted one
    Directed4d backward; ///< from the distorted one to the original
};

/// Distances both ways. Each is exact for its point: the nearest of all tetrahedra. Equal animations: 0. An animation
/// without triangles is infinitely far from one with triangles, and at 0 from another one without. Never NaN. The same for
/// any number of threads. @cost O(F (V + T + samples)) for animations near each other.  @source thesis 7.1.1
Hausdorff4d hausdorff_4d(const MovingMesh& original, const MovingMesh& distorted,
                         const Hausdorff4dOptions& options = {}, const Hausdorff4dWatch& watch = {});

/// `hausdorff_4d`. Holds the positions of both animations.
Metric hausdorff_4d_row();

} // namespace meshreel::metrics
