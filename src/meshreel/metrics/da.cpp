/// Ribbons, frame by frame.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/da.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshreel::metrics {

namespace {

/// The area of the ribbon between two differences, over its length h: straight where they have the same sign, else twisted.
double ribbon_width(double first, double second)
{
    const double a = std::abs(first), b = std::abs(second);
    if (first * second >= 0.0) return 0.5 * (a + b); // (5.3)
    return (a * a + b * b) / (2.0 * (a + b));        // (5.4)
}

/// Two frames of differences as functions of the place in the frame.
struct RibbonEnds {
    std::span<const float> original, distorted, before_original, before_distorted;

    double width(std::size_t i) const
    {
        const double now = double{original[i]} - distorted[i];
        if (before_original.empty()) return std::abs(now);
        return ribbon_width(double{before_original[i]} - before_distorted[i], now);
    }
};

} // namespace

/// What one frame adds.
struct RunningDa::Frame {
    std::array<double, 3> low, high, peak{}; ///< of the original; largest difference
    double width = 0.0;                      ///< of all ribbons that end here, summed: model units
    std::vector<double> vertex_widths = {};
};

RunningDa::RunningDa(std::span<const double> times_s, Threads threads, VertexErrors vertex_errors)
    : times_s_(times_s), threads_(threads), vertex_errors_(std::move(vertex_errors))
{
    low_.fill(std::numeric_limits<double>::infinity());
    high_.fill(-std::numeric_limits<double>::infinity());
}

RunningDa::Frame RunningDa::look_at(const Frames& frames, std::size_t f) const
{
    RibbonEnds ends{frames.original.row(f), frames.distorted.row(f), before_original_, before_distorted_};
    if (f > 0) {
        ends.before_original = frames.original.row(f - 1);
        ends.before_distorted = frames.distorted.row(f - 1);
    }
    Frame frame{low_, high_};
    if (vertex_errors_) frame.vertex_widths.assign(frames.original.cols / 3, 0.0);
    for (std::size_t i = 0; i < ends.original.size(); ++i) {
        const std::size_t axis = i % 3;
        const double x = ends.original[i], width = ends.width(i);
        frame.low[axis] = std::min(frame.low[axis], x); // (5.5)-(5.7)
        frame.high[axis] = std::max(frame.high[axis], x);
        frame.peak[axis] = std::max(frame.peak[axis], std::abs(x - ends.distorted[i])); // (5.11)-(5.13)
        frame.width += width;
        if (vertex_errors_) frame.vertex_widths[i / 3] += width / 3.0;
    }
    return frame;
}

void RunningDa::add(const Frames& frames)
{
    const std::size_t N = frames.original.rows;
    if (N == 0) return;
    std::vector<Frame> found(N);
    parallel_for(N, threads_, [&](std::size_t f) { found[f] = look_at(frames, f); });
    for (const Frame& frame : found) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low_[axis] = std::min(low_[axis], frame.low[axis]);
            high_[axis] = std::max(high_[axis], frame.high[axis]);
            peak_[axis] = std::max(peak_[axis], frame.peak[axis]);
        }
        const std::size_t f = means_.size();
        if (f > 0) area_ += frame.width * (times_s_[f] - times_s_[f - 1]); // (5.9)
        if (vertex_errors_) vertex_errors_(f, frame.vertex_widths);
        // DEVIATES (5.9): divided by V; the printed values of table 7.3 make sense only so.
        means_.push_back(frame.width / static_cast<double>(frames.original.cols));
    }
    before_original_.assign(frames.original.row(N - 1).begin(), frames.original.row(N - 1).end());
    before_distorted_.assign(frames.distorted.row(N - 1).begin(), frames.distorted.row(N - 1).end());
}

double RunningDa::extent() const
{
    double largest = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, high_[axis] - low_[axis]); // (5.8)
    return largest;
}

double RunningDa::normalised(double units) const
{
    if (units == 0.0) return 0.0;
    const double W = extent();
    return W > 0.0 ? units / W : std::numeric_limits<double>::infinity();
}

Da RunningDa::value() const
{
    if (means_.empty()) return {};
    const double duration = times_s_[means_.size() - 1] - times_s_[0],
                 coordinates = static_cast<double>(before_original_.size()); // 3V
    Da da;
    da.mean = normalised(means_.size() == 1 ? means_[0] : area_ / (coordinates * duration)); // (5.10)
    da.peak = normalised(std::max({peak_[0], peak_[1], peak_[2]}));                          // (5.14)
    return da;
}

std::vector<double> RunningDa::per_frame() const
{
    std::vector<double> all;
    for (const double mean : means_) all.push_back(normalised(mean));
    return all;
}

namespace {

class DaMeasurement : public Measurement {
public:
    explicit DaMeasurement(const Context& context)
        : running_(context.original.times_s, context.threads, context.vertex_errors)
    {
    }
    void add(const Frames& frames) override { running_.add(frames); }
    std::vector<double> finish(const Progress&) override { return {running_.value().mean, running_.value().peak}; }
    std::vector<double> per_frame() const override { return running_.per_frame(); }

private:
    RunningDa running_;
};

std::unique_ptr<Measurement> start_da(const Context& context)
{
    return std::make_unique<DaMeasurement>(context);
}

} // namespace

Metric da_row()
{
    constexpr Invariance but_rotation{true, false, true, true};
    static constexpr std::array values{
        Value{"da", "DA error", "", "thesis (5.3)-(5.10)", 0.0, Better::less, but_rotation},
        Value{"da_peak", "DA peak", "", "thesis (5.11)-(5.14)", 0.0, Better::less, but_rotation},
    };
    return {.name = "da",
            .title = "area of the ribbons between the paths of coordinates",
            .values = values,
            .vertex_title = "mean absolute difference",
            .vertex_unit = "units",
            .start = start_da};
}

} // namespace meshreel::metrics
