/// Areas of triangles, frame by frame.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/td.h"

#include <array>
#include <cmath>
#include <limits>

namespace meshreel::metrics {

namespace {

double area_in(std::span<const float> frame, const Triangle& triangle)
{
    std::array<double, 3> u{}, v{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double corner = frame[3ul * triangle[0] + axis];
        u[axis] = frame[3ul * triangle[1] + axis] - corner;
        v[axis] = frame[3ul * triangle[2] + axis] - corner;
    }
    const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return 0.5 * std::sqrt(x * x + y * y + z * z);
}

} // namespace

void RunningTd::add(const Frames& frames)
{
    const std::size_t known = sums_.size();
    if (known == 0 && frames.original.rows > 0) diagonal_ = body_diagonal(frames.original.row(0));
    sums_.resize(known + frames.original.rows);
    parallel_for(frames.original.rows, threads_, [&](std::size_t f) {
        double sum = 0;
        for (const Triangle& triangle : triangles_) {
            const double change =
                area_in(frames.original.row(f), triangle) - area_in(frames.distorted.row(f), triangle);
            sum += change * change;
        }
        sums_[known + f] = sum;
    });
}

double RunningTd::normalised(double sum, std::size_t frames) const
{
    if (sum == 0.0) return 0.0;
    if (diagonal_ == 0.0) return std::numeric_limits<double>::infinity();
    return sum / (static_cast<double>(triangles_.size()) * static_cast<double>(frames) * diagonal_); // (5.18)
}

double RunningTd::value() const
{
    // DEVIATES (5.18): the sum goes over triangles and frames, as its division by F tells.
    double sum = 0;
    for (const double part : sums_) sum += part;
    return normalised(sum, sums_.size());
}

std::vector<double> RunningTd::per_frame() const
{
    std::vector<double> all;
    for (const double sum : sums_) all.push_back(normalised(sum, 1));
    return all;
}

namespace {

class TdMeasurement : public Measurement {
public:
    explicit TdMeasurement(const Context& context) : running_(context.original.triangles, context.threads) {}
    void add(const Frames& frames) override { running_.add(frames); }
    std::vector<double> finish(const Progress&) override { return {running_.value()}; }
    std::vector<double> per_frame() const override { return running_.per_frame(); }

private:
    RunningTd running_;
};

std::unique_ptr<Measurement> start_td(const Context& context)
{
    return std::make_unique<TdMeasurement>(context);
}

} // namespace

Metric td_row()
{
    static constexpr std::array values{
        Value{"td", "TD error", "units^3", "thesis (5.18)", 0.0, Better::less, {true, false, false, true}}};
    return {.name = "td", .title = "triangle difference", .values = values, .start = start_td};
}

} // namespace meshreel::metrics
