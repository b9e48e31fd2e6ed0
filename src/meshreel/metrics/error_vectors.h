/// EV and WEV: how far the error vector of a vertex is from the mean of those near it in space and time.
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "meshreel/metrics/metric.h"

namespace meshreel::metrics {

struct ErrorVectorOptions {
    std::uint32_t window = 5; ///< w: frames before and after whose error vectors count; >= 0
    bool weighted = false;    ///< WEV: a neighbour counts by the inverse length of its edge, in each original frame
    Threads threads;
    VertexErrors vertex_errors = {}; ///< told |ev - la| of each vertex, model units; may be empty
};

/// EV from runs of frames, one after the other: the same to the bit however they are cut. Of the last 2w + 16 frames 56
/// bytes a vertex are kept.
/// @cost O(F (E + w V)).  @source thesis 7.2, (7.1)-(7.3); Zadražil 2007
class RunningErrorVectors {
public:
    RunningErrorVectors(std::uint32_t vertex_count, std::span<const Triangle> triangles, ErrorVectorOptions options);
    void add(const Frames& frames);
    /// Model units, >= 0. A vertex without neighbours, or none that weighs anything, adds 0. To be called once, at the end.
    double finish();
    /// [F] of each frame alone.
    const std::vector<double>& per_frame() const { return per_frame_; }

private:
    /// One frame's error vectors, and what the window needs of it.
    struct Frame {
        std::vector<double> vectors; ///< [3V] ev (7.1)
        std::vector<double> sums; ///< [4V] of the weighted error vectors of each vertex' neighbours, and of the weights
    };
    Frame look_at(std::span<const float> original, std::span<const float> distorted) const;
    void count(std::size_t waiting);
    double deviation(std::size_t f, std::size_t v) const;

    std::uint32_t vertex_count_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
    ErrorVectorOptions options_;
    std::deque<Frame> frames_; ///< those that a window may still need, the first is number first_
    std::size_t first_ = 0;
    std::vector<double> per_frame_;
};

/// "ev".
Metric ev_row();
/// "wev".
Metric wev_row();

} // namespace meshreel::metrics
