/// KG error: the norm of the difference, in percent of the norm of the motion and shape around each frame's centroid.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/motion.h"

namespace meshreel::metrics {

/// 100 |A - A'| / |A - E(A)|, percent, >= 0; E(A) holds each frame's centroid. 0 for equal motions, also where the
/// denominator is 0 (each frame a single point); otherwise infinite there.
/// @cost O(F V).  @source thesis 5.2, (5.2); Karni and Gotsman 2004
double kg_error(const Pair<float>& pair, Threads threads = {});
double kg_error(const Pair<double>& pair, Threads threads = {});

/// The same from runs of frames, one after the other: bit for bit that of all frames at once, however they are cut.
class RunningKg {
public:
    explicit RunningKg(Threads threads = {}) : threads_(threads) {}
    void add(const Pair<float>& frames);
    void add(const Pair<double>& frames);
    double value() const;
    /// [F] of each frame alone.
    const std::vector<double>& per_frame() const { return per_frame_; }

private:
    template <class T>
    void add_frames(const Pair<T>& frames);

    Threads threads_;
    double error_ = 0.0;  ///< |A - A'|^2
    double spread_ = 0.0; ///< |A - E(A)|^2
    std::vector<double> per_frame_;
};

/// "kg"; its vertex errors are the distances |p - p'|.
Metric kg_row();

/// Of two animations with the same V and F.
inline double kg_error(const Animation& original, const Animation& distorted, Threads threads = {})
{
    return kg_error(pair_of(original, distorted), threads);
}

} // namespace meshreel::metrics
