/// Poses what a search wants to look at, and measures it.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

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
    const std::size_t stride = triangles_.size() / enough + 1;
    std::vector<double> variances;
    for (std::size_t t = 0; t < triangles_.size(); t += stride)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t i = 3ul * triangles_[t][c], j = 3ul * triangles_[t][(c + 1) % 3];
            double sum = 0, squares = 0, first = 0;
            for (std::size_t f = 0; f < frames_.rows; ++f) {
                const float* x = frames_.row(f).data();
                const double dx = x[i] - x[j], dy = x[i + 1] - x[j + 1], dz = x[i + 2] - x[j + 2];
                const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
                if (f == 0) first = length;
                sum += length - first;
                squares += (length - first) * (length - first);
            }
            const double F = static_cast<double>(frames_.rows);
            variances.push_back(squares / F - (sum / F) * (sum / F));
        }
    if (variances.empty()) return std::numeric_limits<double>::infinity();
    const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
    std::nth_element(variances.begin(), middle, variances.end());
    return *middle;
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
