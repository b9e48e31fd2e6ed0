/// KG error, frame by frame.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/kg.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "meshreel/base/wide.h"
#include "meshreel/metrics/vertex_error.h"

namespace meshreel::metrics {

namespace {

struct FrameSums {
    double error = 0.0;  ///< sum of |p - p'|^2 over the vertices
    double spread = 0.0; ///< sum of |p - centroid|^2
};

constexpr std::size_t kg_lanes = 24; ///< coordinates summed side by side: eight vertices

using KgLanes = std::array<double, kg_lanes>;

/// Sums over the vertices of each axis, from what stands in the lanes.
std::array<double, 3> by_axis(const KgLanes& lanes)
{
    std::array<double, 3> axes{};
    for (std::size_t i = 0; i < kg_lanes; ++i) axes[i % 3] += lanes[i];
    return axes;
}

/// Adds the coordinates to the lanes, and the squares of the differences; `count` is at most kg_lanes.
template <class T>
inline __attribute__((always_inline)) void add_difference(const T* original, const T* distorted, std::size_t count,
                                                          std::array<KgLanes, 2>& sums)
{
    for (std::size_t i = 0; i < count; ++i) {
        const double value = original[i], error = value - distorted[i];
        sums[0][i] += value;
        sums[1][i] += error * error;
    }
}

template <class T>
inline __attribute__((always_inline)) void add_spread(const T* original, std::size_t count, const KgLanes& mean,
                                                      KgLanes& sums)
{
    for (std::size_t i = 0; i < count; ++i) {
        const double offset = original[i] - mean[i];
        sums[i] += offset * offset;
    }
}

// DEVIATES (5.2): E(A) is each frame's mean x, y and z, which is what Karni and Gotsman subtract.
template <class T>
inline __attribute__((always_inline)) FrameSums measure_frame(std::span<const T> original, std::span<const T> distorted)
{
    const std::size_t size = original.size(), whole = size - size % kg_lanes;
    std::array<KgLanes, 2> sums{};
    for (std::size_t i = 0; i < whole; i += kg_lanes) add_difference(&original[i], &distorted[i], kg_lanes, sums);
    add_difference(original.data() + whole, distorted.data() + whole, size - whole, sums);
    const std::array<double, 3> sum = by_axis(sums[0]), error = by_axis(sums[1]);
    KgLanes mean{}, spreads{};
    for (std::size_t i = 0; i < kg_lanes; ++i) mean[i] = sum[i % 3] / static_cast<double>(size / 3);
    for (std::size_t i = 0; i < whole; i += kg_lanes) add_spread(&original[i], kg_lanes, mean, spreads);
    add_spread(original.data() + whole, size - whole, mean, spreads);
    const std::array<double, 3> spread = by_axis(spreads);
    return {error[0] + error[1] + error[2], spread[0] + spread[1] + spread[2]};
}

MESHREEL_WIDE FrameSums frame_sums(std::span<const float> original, std::span<const float> distorted)
{
    return measure_frame(original, distorted);
}
MESHREEL_WIDE FrameSums frame_sums(std::span<const double> original, std::span<const double> distorted)
{
    return measure_frame(original, distorted);
}

double kg_of(double error, double spread)
{
    if (error == 0.0) return 0.0;
    if (spread == 0.0) return std::numeric_limits<double>::infinity();
    return 100.0 * std::sqrt(error) / std::sqrt(spread); // (5.2)
}

class KgMeasurement : public Measurement {
public:
    explicit KgMeasurement(const Context& context) : running_(context.threads), distances_(context.vertex_errors) {}

    void add(const Frames& frames) override
    {
        running_.add(Pair<float>{frames.original, frames.distorted, {}});
        distances_.add(frames);
    }
    std::vector<double> finish(const Progress&) override { return {running_.value()}; }
    std::vector<double> per_frame() const override { return running_.per_frame(); }

private:
    RunningKg running_;
    VertexDistances distances_;
};

std::unique_ptr<Measurement> start_kg(const Context& context)
{
    return std::make_unique<KgMeasurement>(context);
}

template <class T>
double measured_kg(const Pair<T>& pair, Threads threads)
{
    RunningKg running(threads);
    running.add(pair);
    return running.value();
}

} // namespace

template <class T>
void RunningKg::add_frames(const Pair<T>& pair)
{
    std::vector<FrameSums> frames(pair.frame_count());
    parallel_for(frames.size(), threads_,
                 [&](std::size_t f) { frames[f] = frame_sums(pair.original.row(f), pair.distorted.row(f)); });
    for (const FrameSums& frame : frames) {
        error_ += frame.error;
        spread_ += frame.spread;
        per_frame_.push_back(kg_of(frame.error, frame.spread));
    }
}

void RunningKg::add(const Pair<float>& frames)
{
    add_frames(frames);
}
void RunningKg::add(const Pair<double>& frames)
{
    add_frames(frames);
}

double RunningKg::value() const
{
    return kg_of(error_, spread_);
}

Metric kg_row()
{
    static constexpr std::array values{
        Value{"kg", "KG error", "%", "thesis (5.2)", 0.0, Better::less, {true, true, true, true}}};
    return {.name = "kg",
            .title = "difference over motion and shape, as Karni and Gotsman",
            .values = values,
            .vertex_title = "distance",
            .vertex_unit = "units",
            .start = start_kg};
}

double kg_error(const Pair<float>& pair, Threads threads)
{
    return measured_kg(pair, threads);
}
double kg_error(const Pair<double>& pair, Threads threads)
{
    return measured_kg(pair, threads);
}

} // namespace meshreel::metrics
