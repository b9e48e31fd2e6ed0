/// STED: deviations of relative edge differences in space, relative differences of speed in time.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/sted.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "meshreel/mesh/diameter.h"
#include "meshreel/metrics/near_edges.h"

namespace meshreel::metrics {

namespace {

constexpr std::size_t lanes = 8; ///< frames measured side by side
constexpr std::size_t vertices_a_block = 256;

using Lanes = std::array<double, lanes>;

/// An edge in `lanes` frames.
struct Stretch {
    Lanes difference; ///< (7.5)
    Lanes weight;     ///< its length in the original
};

double sum_of(const std::vector<double>& parts)
{
    double sum = 0;
    for (double part : parts) sum += part;
    return sum;
}

template <class T>
double distance(std::span<const T> row, std::size_t a, std::size_t b)
{
    const double x = double{row[3 * a]} - row[3 * b], y = double{row[3 * a + 1]} - row[3 * b + 1],
                 z = double{row[3 * a + 2]} - row[3 * b + 2];
    return std::sqrt(x * x + y * y + z * z); // (7.4)
}

/// Differences and weights of all edges in frames first .. first + lanes - 1; beyond the end the last frame repeats.
template <class T>
std::vector<Stretch> stretches(const Pair<T>& pair, const NearEdges& near, std::size_t first, bool absolute)
{
    std::vector<Stretch> all(near.edges().size());
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t f = std::min(first + lane, pair.frame_count() - 1);
        const std::span<const T> original = pair.original.row(f), distorted = pair.distorted.row(f);
        for (std::size_t e = 0; e < all.size(); ++e) {
            const auto [a, b] = near.edges()[e];
            const double length = distance(original, a, b);
            const double relative = length > 0.0 ? (length - distance(distorted, a, b)) / length : 0.0; // (7.5)
            // DEVIATES (7.5): signed by default; the authors' tool, which the printed values come from, keeps the sign.
            all[e].difference[lane] = absolute ? std::abs(relative) : relative;
            all[e].weight[lane] = length;
        }
    }
    return all;
}

/// The weighted standard deviation of the differences of some edges, frame by frame.
Lanes deviations(const std::vector<Stretch>& all, std::span<const std::uint32_t> edges)
{
    Lanes weight{}, mean{}, square{};
    for (std::uint32_t e : edges)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            weight[lane] += all[e].weight[lane];
            mean[lane] += all[e].difference[lane] * all[e].weight[lane];
        }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (weight[lane] == 0.0) weight[lane] = 1.0; // then the sums are 0, and so is the deviation
        mean[lane] /= weight[lane];                  // (7.6)
    }
    for (std::uint32_t e : edges)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double off = all[e].difference[lane] - mean[lane];
            square[lane] += off * off * all[e].weight[lane];
        }
    for (std::size_t lane = 0; lane < lanes; ++lane) square[lane] = std::sqrt(square[lane] / weight[lane]); // (7.7)
    return square;
}

template <class T>
double measured_spatial(const Pair<T>& pair, const StedOptions& options)
{
    const auto vertex_count = static_cast<std::uint32_t>(pair.vertex_count());
    const std::size_t frames = pair.frame_count();
    NearEdges near(vertex_count, pair.triangles, options.distance);
    std::vector<double> parts((frames + lanes - 1) / lanes, 0.0);
    for (NearEdges::Run run = near.run_from(0); run.size() > 0; run = near.run_from(run.begin + run.size()))
        parallel_for(parts.size(), options.threads, [&](std::size_t block) {
            const std::vector<Stretch> all = stretches(pair, near, block * lanes, options.absolute_difference);
            const std::size_t used = std::min(lanes, frames - block * lanes);
            for (std::size_t i = 0; i < run.size(); ++i) {
                const Lanes deviation =
                    deviations(all, {run.edges.data() + run.first[i], run.first[i + 1] - run.first[i]});
                for (std::size_t lane = 0; lane < used; ++lane) parts[block] += deviation[lane];
            }
        });
    return sum_of(parts) / (static_cast<double>(vertex_count) * static_cast<double>(frames)); // (7.8)
}

/// Temporal edge lengths (7.10) of vertices first .. last-1: row i holds those of frames 1 .. F-1, after an unused place.
template <class T>
Matrix<double> speeds(MatrixView<const T> motion, std::size_t first, std::size_t last, const auto& length_of)
{
    Matrix<double> result(last - first, motion.rows);
    for (std::size_t f = 1; f < motion.rows; ++f) {
        const std::span<const T> now = motion.row(f), before = motion.row(f - 1);
        for (std::size_t v = first; v < last; ++v) {
            double square = 0;
            for (std::size_t i = 3 * v; i < 3 * v + 3; ++i)
                square += (double{now[i]} - before[i]) * (double{now[i]} - before[i]);
            result(v - first, f) = length_of(square);
        }
    }
    return result;
}

/// The mean over the temporal edges that lie in the window of frames f - w .. f + w with both their ends (7.11).
/// speed[i] is the edge from frame i - 1 to frame i; the one from f - w - 1 is outside.
double window_mean(std::span<const double> speed, std::size_t f, std::size_t window)
{
    // DEVIATES (7.11): divides by the number of edges summed, and sums the same on both sides of f, as the authors do.
    const std::size_t first = f >= window ? f - window + 1 : 1, last = std::min(speed.size(), f + window + 1);
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += speed[i];
    return sum / static_cast<double>(last - first);
}

template <class T>
double measured_temporal(const Pair<T>& pair, const StedOptions& options)
{
    const std::size_t frames = pair.frame_count(), vertices = pair.vertex_count();
    if (frames < 2) return 0.0;
    const double diameter = largest_distance(MatrixView<const T>{pair.original.data, vertices, 3}); // (7.9)
    const double unit = diameter > 0.0 ? diameter * diameter : 1.0, fd = options.frame_distance;
    const auto length_of = [=](double square) { return std::sqrt(square / unit + fd * fd); }; // (7.10)
    std::vector<double> parts((vertices + vertices_a_block - 1) / vertices_a_block);
    parallel_for(parts.size(), options.threads, [&](std::size_t block) {
        const std::size_t first = block * vertices_a_block, last = std::min(vertices, first + vertices_a_block);
        const Matrix<double> original = speeds(pair.original, first, last, length_of);
        const Matrix<double> distorted = speeds(pair.distorted, first, last, length_of);
        for (std::size_t v = 0; v < original.rows; ++v)
            for (std::size_t f = 1; f < frames; ++f)
                parts[block] += std::abs(original(v, f) - distorted(v, f)) /
                                window_mean(original.row(v), f, options.window); // (7.12)
    });
    return sum_of(parts) / (static_cast<double>(vertices) * static_cast<double>(frames - 1)); // (7.13)
}

template <class T>
Sted measured_sted(const Pair<T>& pair, const StedOptions& options)
{
    Sted parts{measured_spatial(pair, options), measured_temporal(pair, options), 0.0};
    const double temporal = options.temporal_weight * parts.temporal;
    parts.total = std::sqrt(parts.spatial * parts.spatial + temporal * temporal); // (7.14)
    return parts;
}

} // namespace

double sted_spatial(const Pair<float>& pair, const StedOptions& options)
{
    return measured_spatial(pair, options);
}
double sted_spatial(const Pair<double>& pair, const StedOptions& options)
{
    return measured_spatial(pair, options);
}
double sted_temporal(const Pair<float>& pair, const StedOptions& options)
{
    return measured_temporal(pair, options);
}
double sted_temporal(const Pair<double>& pair, const StedOptions& options)
{
    return measured_temporal(pair, options);
}
Sted sted(const Pair<float>& pair, const StedOptions& options)
{
    return measured_sted(pair, options);
}
Sted sted(const Pair<double>& pair, const StedOptions& options)
{
    return measured_sted(pair, options);
}

double sted_error(const Animation& original, const Animation& distorted, Threads threads)
{
    StedOptions options;
    options.threads = threads;
    return sted(pair_of(original, distorted), options).total;
}

} // namespace meshreel::metrics
