/// Error vectors, summed over neighbours once a frame and over the window once a frame and vertex.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/error_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "meshreel/mesh/corner_table.h"

namespace meshreel::metrics {

namespace {

constexpr std::size_t error_frames_at_once = 16;

double inverse_length(std::span<const float> frame, std::size_t a, std::size_t b)
{
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = double{frame[3 * a + axis]} - frame[3 * b + axis];
        square += d * d;
    }
    return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
}

} // namespace

RunningErrorVectors::RunningErrorVectors(std::uint32_t vertex_count, std::span<const Triangle> triangles,
                                         ErrorVectorOptions options)
    : vertex_count_(vertex_count), options_(std::move(options))
{
    const CornerTable table(vertex_count, triangles);
    for (std::uint32_t e = 0; e < table.edge_count(); ++e)
        edges_.emplace_back(table.edge(e).low.value, table.edge(e).high.value);
}

RunningErrorVectors::Frame RunningErrorVectors::look_at(std::span<const float> original,
                                                        std::span<const float> distorted) const
{
    Frame frame{std::vector<double>(original.size()), std::vector<double>(4ul * vertex_count_, 0.0)};
    for (std::size_t i = 0; i < original.size(); ++i) frame.vectors[i] = double{original[i]} - distorted[i]; // (7.1)
    const auto add_neighbour = [&](std::size_t v, std::size_t neighbour, double weight) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            frame.sums[4 * v + axis] += weight * frame.vectors[3 * neighbour + axis];
        frame.sums[4 * v + 3] += weight;
    };
    for (const auto& [a, b] : edges_) {
        const double weight = options_.weighted ? inverse_length(original, a, b) : 1.0;
        add_neighbour(a, b, weight);
        add_neighbour(b, a, weight);
    }
    return frame;
}

/// |ev - la| of frame f, counted from the first at hand, whose window is at hand.
double RunningErrorVectors::deviation(std::size_t f, std::size_t v) const
{
    const std::size_t w = options_.window, begin = f - std::min(f, w), end = std::min(frames_.size(), f + w + 1);
    std::array<double, 4> sum{};
    for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += frames_[i].sums[4 * v + k];
    if (sum[3] == 0.0) return 0.0;
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // DEVIATES (7.2): divides by the number of frames in the window, which is one more than max - min.
        const double off = frames_[f].vectors[3 * v + axis] - sum[axis] / sum[3];
        square += off * off;
    }
    return std::sqrt(square);
}

/// Counts the frames at hand but the last `waiting`, and drops those that no window needs any more.
void RunningErrorVectors::count(std::size_t waiting)
{
    const std::size_t done = per_frame_.size(), known = first_ + frames_.size();
    const std::size_t ready = std::max(done, known - std::min(known, waiting));
    Matrix<double> deviations(ready - done, vertex_count_);
    parallel_for(ready - done, options_.threads, [&](std::size_t i) {
        for (std::size_t v = 0; v < vertex_count_; ++v) deviations(i, v) = deviation(done + i - first_, v);
    });
    for (std::size_t f = done; f < ready; ++f) {
        double sum = 0;
        for (const double part : deviations.row(f - done)) sum += part;
        per_frame_.push_back(vertex_count_ == 0 ? 0.0 : sum / vertex_count_);
        if (options_.vertex_errors) options_.vertex_errors(f, deviations.row(f - done));
    }
    for (; first_ + options_.window < ready; ++first_) frames_.pop_front();
}

void RunningErrorVectors::add(const Frames& frames)
{
    for (std::size_t begin = 0; begin < frames.original.rows; begin += error_frames_at_once) {
        std::vector<Frame> next(std::min(error_frames_at_once, frames.original.rows - begin));
        parallel_for(next.size(), options_.threads, [&](std::size_t i) {
            next[i] = look_at(frames.original.row(begin + i), frames.distorted.row(begin + i));
        });
        for (Frame& frame : next) frames_.push_back(std::move(frame));
        count(options_.window);
    }
}

double RunningErrorVectors::finish()
{
    count(0);
    double sum = 0;
    for (const double frame : per_frame_) sum += frame;
    return per_frame_.empty() ? 0.0 : sum / static_cast<double>(per_frame_.size()); // (7.3)
}

namespace {

class ErrorVectorMeasurement : public Measurement {
public:
    ErrorVectorMeasurement(const Context& context, bool weighted)
        : running_(context.original.vertex_count, context.original.triangles,
                   {static_cast<std::uint32_t>(context.parameter("window")), weighted, context.threads,
                    context.vertex_errors})
    {
    }
    void add(const Frames& frames) override { running_.add(frames); }
    std::vector<double> finish(const Progress&) override { return {running_.finish()}; }
    std::vector<double> per_frame() const override { return running_.per_frame(); }

private:
    RunningErrorVectors running_;
};

std::unique_ptr<Measurement> start_ev(const Context& context)
{
    return std::make_unique<ErrorVectorMeasurement>(context, false);
}
std::unique_ptr<Measurement> start_wev(const Context& context)
{
    return std::make_unique<ErrorVectorMeasurement>(context, true);
}

constexpr Invariance ev_invariance{true, true, false, true};
constexpr std::array ev_values{Value{"ev", "EV error", "units", "thesis (7.3)", 0.0, Better::less, ev_invariance}};
constexpr std::array wev_values{
    Value{"wev", "WEV error", "units", "thesis table 7.3, our reading", 0.0, Better::less, ev_invariance}};
constexpr std::array ev_parameters{
    Parameter{"window", "frames on either side whose error vectors count", "frames", 5, 0, 1000, true}};

} // namespace

Metric ev_row()
{
    return {.name = "ev",
            .title = "error vectors against those near them",
            .values = ev_values,
            .parameters = ev_parameters,
            .vertex_title = "deviation of the error vector",
            .vertex_unit = "units",
            .start = start_ev};
}

Metric wev_row()
{
    Metric row = ev_row();
    row.name = "wev";
    row.title = "error vectors against those near them, near ones counting more";
    row.values = wev_values;
    row.start = start_wev;
    return row;
}

} // namespace meshreel::metrics
