/// Hausdorff distance and RMS distance of two surfaces, frame by frame.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshreel/base/parallel.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/surface_bounds.h"

namespace meshreel::metrics {

struct HausdorffOptions {
    double tolerance = 0.0;          ///< upper - lower bound of a frame is at most this, model units, >= 0
    std::size_t most_cuts = 2000000; ///< ... unless more cuts a frame and direction would be needed
    std::size_t samples = 0; ///< a frame and direction: of faces for the RMS; when sampling as many of edges too.
                             ///< 0: as many as triangles, but a thousand at least
    std::uint64_t seed = 1;  ///< of the samples
    bool sampling = false;   ///< as METRO: the largest of vertices, edges and faces sampled, no upper bound
    Threads threads = {};
};

/// One direction of one frame.
struct OneSided {
    DistanceBounds hausdorff; ///< (5.16), model units
    double rms = 0.0;         ///< by samples uniform over the area, model units
};

/// One frame, both directions: forward is from the original to the distorted surface.
struct FrameHausdorff {
    OneSided forward, backward;

    double lower() const;
    double upper() const;
    double rms() const; ///< of the worse direction, as METRO
};

/// The surfaces of two animations, [T] and [T'] triangles. A surface is its triangles, with all their inner points; where
/// there is none, it is its vertices.
class SurfacePair {
public:
    SurfacePair(std::span<const Triangle> original, std::uint32_t vertex_count, std::span<const Triangle> distorted,
                std::uint32_t distorted_vertex_count);
    ~SurfacePair();

    /// positions: [V x 3], [V' x 3]; vertices: [V] or empty, is filled with the
    /// distance of every original vertex, model units. A direction from a surface with no point at all is 0, to one from
    /// any other infinite. @source thesis 5.4, (5.15)-(5.17)
    FrameHausdorff measure(std::span<const float> original, std::span<const float> distorted,
                           const HausdorffOptions& options, std::span<double> vertices = {}) const;

private:
    struct Side;
    std::unique_ptr<const Side> original_, distorted_;
    bool same_triangles_;
};

/// "hausdorff"; its vertex errors are the distances of the original vertices from the distorted surface.
Metric hausdorff_row();

} // namespace meshreel::metrics
