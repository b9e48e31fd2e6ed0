/// Temporal edges, a row a frame, and their means over windows of rows.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/sted_temporal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "meshreel/base/wide.h"
#include "meshreel/mesh/diameter.h"

namespace meshreel::metrics {

namespace {

constexpr std::size_t speed_lanes = 32; ///< vertices measured side by side
constexpr std::size_t speed_frames_at_once = 8;

/// How a step becomes a length: sqrt(|step|^2 per_square + constant).
struct SpeedScale {
    double per_square, constant;
};

/// lengths: [V] of the steps from one frame to the next, [3V] each.
template <class Now, class Before>
inline __attribute__((always_inline)) void measure_speeds(std::span<const Now> now, std::span<const Before> before,
                                                          SpeedScale scale, double* __restrict lengths)
{
    const std::size_t count = now.size() / 3;
    std::array<double, 3 * speed_lanes> square{};
    std::array<double, speed_lanes> all{};
    for (std::size_t v = 0; v < count; v += speed_lanes) {
        const std::size_t used = std::min(speed_lanes, count - v);
        for (std::size_t i = 0; i < 3 * used; ++i) square[i] = double{now[3 * v + i]} - before[3 * v + i];
        for (double& d : square) d *= d;
        for (std::size_t lane = 0; lane < speed_lanes; ++lane)
            all[lane] = square[3 * lane] + square[3 * lane + 1] + square[3 * lane + 2];
        for (double& length : all) length = std::sqrt(length * scale.per_square + scale.constant); // (7.10)
        std::copy_n(all.begin(), used, lengths + v);
    }
}

MESHREEL_WIDEST void speeds(std::span<const float> now, std::span<const float> before, SpeedScale scale,
                            double* lengths)
{
    measure_speeds(now, before, scale, lengths);
}
MESHREEL_WIDEST void speeds(std::span<const double> now, std::span<const double> before, SpeedScale scale,
                            double* lengths)
{
    measure_speeds(now, before, scale, lengths);
}
MESHREEL_WIDEST void speeds(std::span<const float> now, std::span<const double> before, SpeedScale scale,
                            double* lengths)
{
    measure_speeds(now, before, scale, lengths);
}

/// A row of the original and the distorted motion, and the original rows of its window.
struct SpeedWindow {
    const double* __restrict original, * __restrict distorted;
    std::span<const double* const> rows;
};

/// The sum of |tel - tel'| / s over `count` vertices, a multiple of speed_lanes.
MESHREEL_WIDEST double sum_of_differences(const SpeedWindow& window, std::size_t count)
{
    std::array<double, speed_lanes> sums{};
    const double row_count = static_cast<double>(window.rows.size());
    for (std::size_t v = 0; v < count; v += speed_lanes) {
        std::array<double, speed_lanes> all{};
        for (const double* const row : window.rows)
            for (std::size_t lane = 0; lane < speed_lanes; ++lane) all[lane] += row[v + lane];
        for (std::size_t lane = 0; lane < speed_lanes; ++lane)
            sums[lane] += std::abs(window.original[v + lane] - window.distorted[v + lane]) * row_count / all[lane];
    } // (7.11), (7.12)
    double sum = 0;
    for (const double part : sums) sum += part;
    return sum;
}

} // namespace

TemporalSted::TemporalSted(std::size_t vertex_count, const StedOptions& options)
    : vertex_count_(vertex_count), padded_((vertex_count + speed_lanes - 1) / speed_lanes * speed_lanes),
      options_(options)
{
}

/// Edges of frames begin .. end - 1.
template <class T>
void TemporalSted::add_edges(const Pair<T>& frames, std::size_t begin, std::size_t end)
{
    const std::size_t first = edges_.size();
    for (std::size_t f = begin; f < end; ++f) {
        if (f == 0 && before_original_.empty()) continue;
        if (spare_.empty()) spare_.push_back({std::vector<double>(padded_, 1.0), std::vector<double>(padded_, 1.0)});
        edges_.push_back(std::move(spare_.back()));
        spare_.pop_back();
    }
    parallel_for(edges_.size() - first, options_.threads, [&](std::size_t i) {
        Edges& edges = edges_[first + i];
        const std::size_t f = end - (edges_.size() - first) + i;
        const auto measure = [&](MatrixView<const T> motion, const std::vector<double>& before, double* lengths) {
            const SpeedScale scale{per_square_, options_.frame_distance * options_.frame_distance};
            if (f > 0)
                speeds(motion.row(f), motion.row(f - 1), scale, lengths);
            else
                speeds(motion.row(f), std::span(before), scale, lengths);
        };
        measure(frames.original, before_original_, edges.original.data());
        measure(frames.distorted, before_distorted_, edges.distorted.data());
    });
}

template <class T>
void TemporalSted::add_frames(const Pair<T>& frames)
{
    const std::size_t N = frames.frame_count();
    if (N == 0 || vertex_count_ == 0) return;
    if (per_frame_.empty()) {
        const double diameter = largest_distance(MatrixView<const T>{frames.original.data, vertex_count_, 3}); // (7.9)
        per_square_ = diameter > 0.0 ? 1.0 / (diameter * diameter) : 1.0;
        per_frame_.push_back(0.0);
    }
    for (std::size_t begin = 0; begin < N; begin += speed_frames_at_once) {
        add_edges(frames, begin, std::min(N, begin + speed_frames_at_once));
        count(options_.window);
    }
    before_original_.assign(frames.original.row(N - 1).begin(), frames.original.row(N - 1).end());
    before_distorted_.assign(frames.distorted.row(N - 1).begin(), frames.distorted.row(N - 1).end());
}

template void TemporalSted::add_frames(const Pair<float>&);
template void TemporalSted::add_frames(const Pair<double>&);

/// The mean over the temporal edges that lie in the window of frames e - w .. e + w with both their ends (7.11).
/// Edge e goes from frame e - 1 to frame e; the one from f - w - 1 is outside.
double TemporalSted::frame_value(std::size_t e) const
{
    // DEVIATES (7.11): divides by the number of edges summed, and sums the same on both sides of f, as the authors do.
    const std::size_t w = options_.window, begin = e >= w ? e - w + 1 : 1,
                      end = std::min(first_ + edges_.size(), e + w + 1);
    std::vector<const double*> rows;
    for (std::size_t i = begin; i < end; ++i) rows.push_back(edges_[i - first_].original.data());
    const Edges& edges = edges_[e - first_];
    return sum_of_differences({edges.original.data(), edges.distorted.data(), rows}, padded_) /
           static_cast<double>(vertex_count_);
}

/// Counts all frames whose edges are known but the last `waiting`, and drops edges that no window needs any more.
void TemporalSted::count(std::size_t waiting)
{
    const std::size_t done = per_frame_.size(), known = first_ + edges_.size();
    const std::size_t ready = std::max(done, known - std::min(known, waiting));
    if (vertex_count_ == 0 || done == 0) return;
    per_frame_.resize(ready);
    parallel_for(ready - done, options_.threads, [&](std::size_t i) { per_frame_[done + i] = frame_value(done + i); });
    for (; first_ + options_.window <= ready; ++first_) {
        spare_.push_back(std::move(edges_.front()));
        edges_.pop_front();
    }
}

double TemporalSted::value() const
{
    double sum = 0;
    for (const double frame : per_frame_) sum += frame;
    return per_frame_.size() < 2 ? 0.0 : sum / static_cast<double>(per_frame_.size() - 1); // (7.13)
}

} // namespace meshreel::metrics
