/// The spatial part of STED: how unevenly the edges near each vertex are stretched.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "meshreel/metrics/near_edges.h"
#include "meshreel/metrics/sted.h"

namespace meshreel::metrics {

/// From runs of frames, one after the other.  @cost O(F E).  @source thesis 7.3.1, (7.4)-(7.8)
class SpatialSted {
public:
    SpatialSted(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options);
    ~SpatialSted();
    void add(const Pair<float>& frames) { add_frames(frames); }
    void add(const Pair<double>& frames) { add_frames(frames); }
    double value() const; ///< (7.8)
    const std::vector<double>& per_frame() const { return per_frame_; }

private:
    /// What is held of a few frames side by side; kept from block to block.
    struct Room;
    /// What some frames add.
    struct Parts {
        std::vector<double> sums;  ///< of the deviations of each frame
        Matrix<double> deviations; ///< [N x V], where somebody is told
    };

    template <class T>
    void add_frames(const Pair<T>& frames);
    template <class T>
    void add_block(const Pair<T>& frames, Room& room, Parts& parts) const;
    void add_run(const NearEdges::Run& run, Room& room, Parts& parts) const;

    std::uint32_t vertex_count_;
    StedOptions options_;
    NearEdges near_;
    NearEdges::Run first_run_;                 ///< mostly the only one
    std::vector<std::unique_ptr<Room>> rooms_; ///< one a thread
    std::vector<double> per_frame_;
};

} // namespace meshreel::metrics
