/// The temporal part of STED: how far the speeds of vertices are off, beside how fast they usually are.
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "meshreel/metrics/sted.h"

namespace meshreel::metrics {

/// From runs of frames, one after the other. A frame is counted once all frames of its window are known; the speeds of 2w +
/// 8 frames are kept, 16 bytes a vertex and frame.  @cost O(F V w).  @source thesis 7.3.2, (7.9)-(7.13)
class TemporalSted {
public:
    TemporalSted(std::size_t vertex_count, const StedOptions& options);
    void add(const Pair<float>& frames) { add_frames(frames); }
    void add(const Pair<double>& frames) { add_frames(frames); }
    /// Counts the last frames.
    void finish() { count(0); }
    double value() const; ///< (7.13), after finish()
    /// [F] 0 in the first frame, which has no speed.
    const std::vector<double>& per_frame() const { return per_frame_; }

private:
    /// Lengths of the temporal edges (7.10) that end in a frame, [V] and some more that are alike.
    struct Edges {
        std::vector<double> original, distorted;
    };
    template <class T>
    void add_frames(const Pair<T>& frames);
    template <class T>
    void add_edges(const Pair<T>& frames, std::size_t begin, std::size_t end);
    void count(std::size_t waiting);
    double frame_value(std::size_t e) const;

    std::size_t vertex_count_, padded_;
    StedOptions options_;
    double per_square_ = 1.0;  ///< 1 / ld^2 (7.9)
    std::deque<Edges> edges_;  ///< those at hand; the first ends in frame first_
    std::vector<Edges> spare_; ///< room of edges no longer needed
    std::size_t first_ = 1;
    std::vector<double> before_original_, before_distorted_; ///< the last frame, [3V]
    std::vector<double> per_frame_;
};

} // namespace meshreel::metrics
