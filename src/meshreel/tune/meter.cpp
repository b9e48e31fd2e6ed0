/// Poses what a search wants to look at, and measures it.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/meter.h"

#include <algorithm>
#include <cmath>

#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"

namespace meshreel::tune {

Meter::Meter(MatrixView<const float> frames, std::span<const Triangle> triangles, Threads threads)
    : frames_(frames), triangles_(triangles), threads_(threads)
{
    constexpr std::size_t most_frames = 32;
    const std::size_t F = frames.rows, count = std::min(F, most_frames);
    originals_ = Matrix<double>(count, frames.cols);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t f = (2 * i + 1) * F / (2 * count); // the middles of equal parts
        some_.push_back(only(static_cast<std::uint32_t>(f)));
        std::ranges::copy(frames.row(f), originals_.row(i).begin());
    }
}

double Meter::largest_distance(const codecs::Trajectories& decoded) const
{
    Matrix<float> rebuilt(frames_.rows, frames_.cols);
    codecs::rebuild(decoded, rebuilt.view(), threads_);
    return std::sqrt(metrics::vertex_error({frames_, rebuilt.view(), {}}, threads_).largest_square);
}

double Meter::sted(const codecs::Trajectories& decoded) const
{
    Matrix<double> posed(originals_.rows, originals_.cols);
    codecs::pose(decoded, {some_, 0}, posed.view(), threads_);
    metrics::StedOptions options;
    options.threads = threads_;
    return metrics::sted_spatial(metrics::Pair<double>{originals_.view(), posed.view(), triangles_}, options);
}

double mean_edge(std::span<const float> frame, std::span<const Triangle> triangles)
{
    double sum = 0;
    for (const Triangle& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            double square = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double d =
                    static_cast<double>(frame[3ul * triangle[i] + axis]) - frame[3ul * triangle[(i + 1) % 3] + axis];
                square += d * d;
            }
            sum += std::sqrt(square);
        }
    return triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(triangles.size()));
}

} // namespace meshreel::tune
