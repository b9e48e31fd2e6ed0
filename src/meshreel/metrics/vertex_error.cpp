/// RMS, largest error and PSNR from one pass over the frames.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/vertex_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meshreel::metrics {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Sum and largest of one frame's squared distances.
VertexError frame_error(std::span<const float> original, std::span<const float> distorted)
{
    VertexError error;
    for (std::size_t i = 0; i < original.size(); i += 3) {
        double square = 0;
        for (std::size_t axis = i; axis < i + 3; ++axis) {
            const double d = double{original[axis]} - distorted[axis];
            square += d * d;
        }
        error.mean_square += square;
        error.largest_square = std::max(error.largest_square, square);
    }
    return error;
}

} // namespace

void RunningVertexError::add(const Pair<float>& pair)
{
    std::vector<VertexError> frames(pair.frame_count());
    parallel_for(frames.size(), threads_,
                 [&](std::size_t f) { frames[f] = frame_error(pair.original.row(f), pair.distorted.row(f)); });
    for (const VertexError& frame : frames) {
        square_ += frame.mean_square;
        largest_square_ = std::max(largest_square_, frame.largest_square);
    }
    points_ += frames.size() * pair.vertex_count();
}

VertexError RunningVertexError::value() const
{
    return {square_ / static_cast<double>(points_), largest_square_};
}

VertexError vertex_error(const Pair<float>& pair, Threads threads)
{
    RunningVertexError running(threads);
    running.add(pair);
    return running.value();
}

VertexError vertex_error(const Animation& original, const Animation& distorted, Threads threads)
{
    return vertex_error(pair_of(original, distorted), threads);
}

double rms_error(const Animation& original, const Animation& distorted, Threads threads)
{
    return std::sqrt(vertex_error(original, distorted, threads).mean_square);
}

double max_error(const Animation& original, const Animation& distorted, Threads threads)
{
    return std::sqrt(vertex_error(original, distorted, threads).largest_square);
}

double max_error_relative(const Animation& original, const Animation& distorted, Threads threads)
{
    const double error = max_error(original, distorted, threads), diagonal = body_diagonal(original);
    if (error == 0.0) return 0.0;
    return diagonal > 0.0 ? 100.0 * error / diagonal : unbounded;
}

double psnr(const Animation& original, const Animation& distorted, Threads threads)
{
    const double mse = vertex_error(original, distorted, threads).mean_square, diagonal = body_diagonal(original);
    if (mse == 0.0) return unbounded;
    return 10.0 * std::log10(diagonal * diagonal / mse);
}

} // namespace meshreel::metrics
