/// DA error, the ribbon measure of MPEG: the area between the paths of a coordinate and of its distorted self.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "meshreel/metrics/metric.h"

namespace meshreel::metrics {

/// Both without unit, >= 0, larger is worse.
struct Da {
    double mean = 0.0; ///< D_A (5.10), over the number of vertices too
    double peak = 0.0; ///< E_P (5.14)
};

/// DA from runs of frames, one after the other: the same to the bit however they are cut.
/// @cost O(F V).  @source thesis 5.3, (5.3)-(5.14)
class RunningDa {
public:
    /// times_s: [F], must outlive it. vertex_errors: told the mean absolute difference of the three coordinates over
    /// the time since the frame before, model units; of the first frame, in it.
    explicit RunningDa(std::span<const double> times_s, Threads threads = {}, VertexErrors vertex_errors = {});
    void add(const Frames& frames);
    /// 0 for equal motions; where the original has no extent, infinite for others.
    Da value() const;
    /// [F] the mean since the frame before; of the first frame, in it.
    std::vector<double> per_frame() const;

private:
    struct Frame;
    /// A row of differences, [3V], and the one before it; empty where there is none.
    Frame look_at(const Frames& frames, std::size_t f) const;
    double extent() const; ///< W (5.8)
    double normalised(double units) const;

    std::span<const double> times_s_;
    Threads threads_;
    VertexErrors vertex_errors_;
    std::vector<float> before_original_, before_distorted_; ///< [3V] the last frame
    std::array<double, 3> low_, high_, peak_{};
    double area_ = 0.0;         ///< of all ribbons, model units times seconds
    std::vector<double> means_; ///< [F] model units
};

/// "da": mean and peak.
Metric da_row();

} // namespace meshreel::metrics
