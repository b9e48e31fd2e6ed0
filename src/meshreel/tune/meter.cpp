/// Poses what a search wants to look at, and measures it.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/meter.h"

#include <algorithm>
#include <cmath>

#include "meshreel/mesh/frame_source.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"

namespace meshreel::tune {

Meter::Meter(MatrixView<const float> frames, std::span<const Triangle> triangles, Threads threads)
    : frames_(frames), triangles_(triangles), threads_(threads)
{
}

double Meter::largest_distance(const codecs::Trajectories& decoded) const
{
    metrics::RunningVertexError error(threads_);
    const std::size_t run = frames_a_run(static_cast<std::uint32_t>(frames_.cols / 3));
    for (std::size_t first = 0; first < frames_.rows; first += run) {
        std::vector<FrameMix> wanted;
        for (std::size_t f = first; f < std::min(frames_.rows, first + run); ++f)
            wanted.push_back(only(static_cast<std::uint32_t>(f)));
        Matrix<double> posed(wanted.size(), frames_.cols);
        codecs::pose(decoded, {wanted, 0}, posed.view(), threads_);
        Matrix<float> rounded(posed.rows, posed.cols);
        std::ranges::copy(posed.values, rounded.values.begin());
        error.add({{frames_.row(first).data(), posed.rows, posed.cols}, rounded.view(), {}});
    }
    return std::sqrt(error.value().largest_square);
}

double Meter::sted(const codecs::Trajectories& decoded) const
{
    constexpr std::size_t most_frames = 32, most_points = 2'000'000;
    const std::size_t F = frames_.rows, count = std::min({F, most_frames, 1 + 3 * most_points / frames_.cols});
    std::vector<FrameMix> wanted;
    Matrix<double> originals(count, frames_.cols), posed(count, frames_.cols);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t f = (2 * i + 1) * F / (2 * count); // the middles of equal parts
        wanted.push_back(only(static_cast<std::uint32_t>(f)));
        std::ranges::copy(frames_.row(f), originals.row(i).begin());
    }
    codecs::pose(decoded, {wanted, 0}, posed.view(), threads_);
    metrics::StedOptions options;
    options.threads = threads_;
    return metrics::sted_spatial(metrics::Pair<double>{originals.view(), posed.view(), triangles_}, options);
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
