/// TD error: how much the areas of triangles change.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshreel/metrics/metric.h"

namespace meshreel::metrics {

/// TD from runs of frames, one after the other: the same to the bit however they are cut.
/// @cost O(F T).  @source thesis 5.5, (5.18); Zadražil 2007
class RunningTd {
public:
    /// triangles: [T], must outlive it.
    explicit RunningTd(std::span<const Triangle> triangles, Threads threads = {})
        : triangles_(triangles), threads_(threads)
    {
    }
    void add(const Frames& frames);
    /// Cubed model units, >= 0. 0 without triangles; where the first frame has no extent, 0 or infinite.
    double value() const;
    /// [F] of each frame alone.
    std::vector<double> per_frame() const;

private:
    double normalised(double sum, std::size_t frames) const;

    std::span<const Triangle> triangles_;
    Threads threads_;
    double diagonal_ = 0.0;    ///< d, of the first frame
    std::vector<double> sums_; ///< [F] of squared differences of areas
};

/// "td".
Metric td_row();

} // namespace meshreel::metrics
