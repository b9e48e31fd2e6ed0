/// KG error, frame by frame.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/kg.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "meshreel/metrics/vertex_error.h"

namespace meshreel::metrics {

namespace {

struct FrameSums {
    double error = 0.0;  ///< sum of |p - p'|^2 over the vertices
    double spread = 0.0; ///< sum of |p - centroid|^2
};

// DEVIATES (5.2): E(A) is each frame's mean x, y and z, which is what Karni and Gotsman subtract.
template <class T>
FrameSums frame_sums(std::span<const T> original, std::span<const T> distorted)
{
    std::array<double, 3> mean{};
    for (std::size_t i = 0; i < original.size(); i += 3)
        for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += original[i + axis];
    for (double& m : mean) m /= static_cast<double>(original.size() / 3);
    std::array<FrameSums, 3> axes{};
    for (std::size_t i = 0; i < original.size(); i += 3)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double value = original[i + axis];
            const double error = value - distorted[i + axis], offset = value - mean[axis];
            axes[axis].error += error * error;
            axes[axis].spread += offset * offset;
        }
    return {axes[0].error + axes[1].error + axes[2].error, axes[0].spread + axes[1].spread + axes[2].spread};
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
