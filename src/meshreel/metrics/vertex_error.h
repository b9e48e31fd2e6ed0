/// Measures of how far vertices are from where they were: MSE, RMS, largest error, PSNR.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/motion.h"

namespace meshreel::metrics {

/// Distances |p - p'| of all vertices in all frames, squared.
struct VertexError {
    double mean_square = 0.0; ///< sum of squared distances / (F V): a mean over vertices, not over coordinates
    double largest_square = 0.0;
};

/// Both motions have the same V and F. The same for any number of threads. @cost O(F V).
VertexError vertex_error(const Pair<float>& pair, Threads threads = {});
VertexError vertex_error(const Animation& original, const Animation& distorted, Threads threads = {});

/// The same from runs of frames, one after the other: bit for bit that of all frames at once, however they are cut.
class RunningVertexError {
public:
    explicit RunningVertexError(Threads threads = {}) : threads_(threads) {}
    void add(const Pair<float>& frames);
    VertexError value() const;
    /// [F] root of the mean squared distance of each frame alone.
    const std::vector<double>& per_frame() const { return per_frame_; }

private:
    Threads threads_;
    std::vector<double> per_frame_;
    double square_ = 0.0, largest_square_ = 0.0;
    std::size_t points_ = 0; ///< F V
};

/// Root of the mean squared distance, model units.
double rms_error(const Animation& original, const Animation& distorted, Threads threads = {});

/// The largest distance of any vertex in any frame, model units.
double max_error(const Animation& original, const Animation& distorted, Threads threads = {});

/// The largest distance in percent of the original's body diagonal (see body_diagonal). Where that is 0: 0 for equal
/// animations, else infinite.
double max_error_relative(const Animation& original, const Animation& distorted, Threads threads = {});

/// 10 log10(D^2 / MSE), dB; D the original's body diagonal, MSE the mean squared distance of vertices (a third of it,
/// the mean over coordinates, would give 4.77 dB more). Larger is better; infinite for equal animations, minus infinite
/// where D is 0 and they differ.  @source thesis 5.1
// DEVIATES (5.1): printed as 20 log of a mean square, without its sign.
double psnr(const Animation& original, const Animation& distorted, Threads threads = {});

/// Tells the distances |p - p'| of the vertices of frame after frame to whoever wants to know; model units.
class VertexDistances {
public:
    explicit VertexDistances(VertexErrors told) : told_(std::move(told)) {}
    void add(const Frames& frames);

private:
    VertexErrors told_;
    std::size_t frame_ = 0;
};

/// "vertex_error": RMS, MSE, largest error, PSNR and (5.1) as printed; its vertex errors are the distances.
Metric vertex_error_row();

} // namespace meshreel::metrics
