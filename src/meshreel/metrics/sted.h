/// STED: the spatio-temporal edge difference, the measure nearest to what people see.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/motion.h"

namespace meshreel::metrics {

/// The constants of STED. The defaults are those of the thesis, fitted to its subjective tests (thesis 7.4).
struct StedOptions {
    std::uint32_t distance = 1;        ///< d: edges at vertices at most so many edges away count as near; >= 0
    std::uint32_t window = 5;          ///< w: frames before and after that a vertex' speed is averaged over; >= 1
    double frame_distance = 0.0003;    ///< fd: the time between two frames, in body sizes; > 0
    double temporal_weight = 9.144e-5; ///< c: what the temporal part counts beside the spatial one; >= 0
    /// Relative edge differences without their sign, as (7.5) prints them. Default: with their sign, as the authors'
    /// own tool and the figures in the thesis have them.
    bool absolute_difference = false;
    Threads threads;
    /// Told the deviation (7.7) of each vertex in frame after frame; may be empty.
    VertexErrors vertex_errors = {};
};

/// STED and its parts; all without unit, >= 0, larger is worse.
struct Sted {
    double spatial = 0.0;  ///< (7.8): how unevenly edges near each vertex are stretched
    double temporal = 0.0; ///< (7.13): how far speeds are off
    double total = 0.0;    ///< (7.14): sqrt(spatial^2 + (c temporal)^2)
};

/// The spatial part. Edges of no length in the original weigh nothing; a vertex without edges (isolated, or all of its
/// edges of no length) adds 0 to the mean. Degenerate triangles have no edges.
/// @cost O(F E) at distance 0 and 1.
double sted_spatial(const Pair<float>& pair, const StedOptions& options = {});
double sted_spatial(const Pair<double>& pair, const StedOptions& options = {});

/// The temporal part. 0 for a single frame. Lengths are in body sizes: the largest distance of two vertices of the first
/// original frame (7.9); where that is 0, in model units.  @cost O(F V w).
double sted_temporal(const Pair<float>& pair, const StedOptions& options = {});
double sted_temporal(const Pair<double>& pair, const StedOptions& options = {});

/// Both parts and their sum. Exactly 0 for equal motions; the same for any number of threads.
/// @source thesis 7.3, (7.4)-(7.14)
Sted sted(const Pair<float>& pair, const StedOptions& options = {});
Sted sted(const Pair<double>& pair, const StedOptions& options = {});

/// Both parts from runs of frames, one after the other: bit for bit those of all frames at once, however they are cut. The
/// speeds of the last frames are kept, as the window of the next ones looks back at them: 300 bytes a vertex; the
/// spatial part holds four frames of one thread in 600 more.
class RunningSted {
public:
    RunningSted(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options = {});
    ~RunningSted();
    /// The next frames; the triangles are those given above.
    void add(const Pair<float>& frames);
    void add(const Pair<double>& frames);
    /// Of all frames added. To be called once, at the end. @pre a frame was added
    Sted finish();
    /// [F] of each frame alone, after finish().
    std::vector<double> per_frame() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// "sted": total, spatial and temporal part; its vertex errors are the deviations (7.7).
Metric sted_row();

/// The total, with the default constants.
double sted_error(const Animation& original, const Animation& distorted, Threads threads = {});

} // namespace meshreel::metrics
