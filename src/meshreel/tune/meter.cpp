/// Poses what a search wants to look at, and measures it.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "meshreel/codecs/length_sums.h"
#include "meshreel/mesh/frame_source.h"
#include "meshreel/metrics/sted.h"

namespace meshreel::tune {

Meter::Meter(MatrixView<const float> frames, std::span<const Triangle> triangles, Threads threads)
    : frames_(frames), triangles_(triangles), threads_(threads)
{
}

namespace {

/// Where each vertex has been farthest off.
class WorstFrames {
public:
    explicit WorstFrames(std::size_t vertices) : squares_(vertices, 0.0), nudges_(vertices) {}

    void add(std::size_t frame, std::span<const float> original, std::span<const float> posed)
    {
        for (std::size_t v = 0; v < squares_.size(); ++v) {
            std::array<double, 3> back;
            double square = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                back[axis] = double{original[3 * v + axis]} - posed[3 * v + axis];
                square += back[axis] * back[axis];
            }
            if (!(square > squares_[v])) continue;
            squares_[v] = square;
            nudges_[v] = {static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(frame), back};
        }
    }
    Meter::Distances beyond(double limit) const
    {
        Meter::Distances result;
        for (std::size_t v = 0; v < squares_.size(); ++v) {
            result.largest = std::max(result.largest, std::sqrt(squares_[v]));
            if (squares_[v] > limit * limit) result.nudges.push_back(nudges_[v]);
        }
        return result;
    }

private:
    std::vector<double> squares_;
    std::vector<codecs::Nudge> nudges_;
};

/// From vertex i to vertex j.
double length_in(std::span<const float> frame, std::uint32_t i, std::uint32_t j)
{
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = double{frame[3ul * i + axis]} - frame[3ul * j + axis];
        square += d * d;
    }
    return std::sqrt(square);
}

codecs::LengthSums lengths_over_time(MatrixView<const float> frames, std::uint32_t i, std::uint32_t j)
{
    codecs::LengthSums sums{.base = length_in(frames.row(0), i, j)};
    for (std::size_t f = 0; f < frames.rows; ++f) sums.add(length_in(frames.row(f), i, j));
    return sums;
}

} // namespace

Meter::Distances Meter::distances(const codecs::Trajectories& decoded, double limit) const
{
    WorstFrames worst(frames_.cols / 3);
    const std::size_t run = frames_a_run(static_cast<std::uint32_t>(frames_.cols / 3));
    for (std::size_t first = 0; first < frames_.rows; first += run) {
        std::vector<FrameMix> wanted;
        for (std::size_t f = first; f < std::min(frames_.rows, first + run); ++f)
            wanted.push_back(only(static_cast<std::uint32_t>(f)));
        Matrix<double> posed(wanted.size(), frames_.cols);
        codecs::pose(decoded, {wanted, 0}, posed.view(), threads_);
        Matrix<float> rounded(posed.rows, posed.cols);
        std::ranges::copy(posed.values, rounded.values.begin());
        for (std::size_t f = 0; f < posed.rows; ++f) worst.add(first + f, frames_.row(first + f), rounded.row(f));
    }
    return worst.beyond(limit);
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

double Meter::length_spread() const
{
    constexpr std::size_t enough = 2048; // triangles
    std::vector<codecs::LengthSums> sums;
    for (std::size_t t = 0; t < triangles_.size(); t += triangles_.size() / enough + 1)
        for (std::size_t c = 0; c < 3; ++c)
            sums.push_back(lengths_over_time(frames_, triangles_[t][c], triangles_[t][(c + 1) % 3]));
    if (sums.empty()) return std::numeric_limits<double>::infinity();
    return codecs::middle_variance(sums, static_cast<double>(frames_.rows));
}

double mean_edge(std::span<const float> frame, std::span<const Triangle> triangles)
{
    double sum = 0;
    for (const Triangle& triangle : triangles)
        for (std::size_t c = 0; c < 3; ++c) sum += length_in(frame, triangle[c], triangle[(c + 1) % 3]);
    return triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(triangles.size()));
}

} // namespace meshreel::tune
