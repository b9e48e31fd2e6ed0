/// MSE, RMS, largest error and PSNR from one pass over the frames.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/vertex_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace meshreel::metrics {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Sum and largest of one frame's squared distances.
VertexError frame_error(std::span<const float> original, std::span<const float> distorted)
{
    VertexError error;
    for (std::size_t i = 0; i < original.size(); i += 3) {
        double square = 0;
        for (std::size_t axis = i; axis < i + 3; ++axis) {
            const double d = double{original[axis]} - distorted[axis];
            square += d * d;
        }
        error.mean_square += square;
        error.largest_square = std::max(error.largest_square, square);
    }
    return error;
}

double largest_in_percent(double error, double diagonal)
{
    if (error == 0.0) return 0.0;
    return diagonal > 0.0 ? 100.0 * error / diagonal : unbounded;
}

double psnr_of(double mse, double diagonal)
{
    if (mse == 0.0) return unbounded;
    return 10.0 * std::log10(diagonal * diagonal / mse);
}

class VertexErrorMeasurement : public Measurement {
public:
    explicit VertexErrorMeasurement(const Context& context)
        : running_(context.threads), distances_(context.vertex_errors)
    {
    }

    void add(const Frames& frames) override
    {
        if (running_.per_frame().empty() && frames.original.rows > 0) diagonal_ = body_diagonal(frames.original.row(0));
        running_.add({frames.original, frames.distorted, {}});
        distances_.add(frames);
    }

    std::vector<double> finish(const Progress&) override
    {
        const VertexError error = running_.value();
        const double largest = std::sqrt(error.largest_square), decibels = psnr_of(error.mean_square, diagonal_);
        // (5.1) as printed, the mean taken over the frames too: 20 log10(MSE / D^2), which is -2 PSNR
        return {std::sqrt(error.mean_square),           error.mean_square, largest,
                largest_in_percent(largest, diagonal_), decibels,          -2.0 * decibels};
    }
    std::vector<double> per_frame() const override { return running_.per_frame(); }

private:
    RunningVertexError running_;
    VertexDistances distances_;
    double diagonal_ = 0.0;
};

std::unique_ptr<Measurement> start_vertex_error(const Context& context)
{
    return std::make_unique<VertexErrorMeasurement>(context);
}

} // namespace

void RunningVertexError::add(const Pair<float>& pair)
{
    std::vector<VertexError> frames(pair.frame_count());
    parallel_for(frames.size(), threads_,
                 [&](std::size_t f) { frames[f] = frame_error(pair.original.row(f), pair.distorted.row(f)); });
    for (const VertexError& frame : frames) {
        square_ += frame.mean_square;
        largest_square_ = std::max(largest_square_, frame.largest_square);
        per_frame_.push_back(std::sqrt(frame.mean_square / static_cast<double>(pair.vertex_count())));
    }
    points_ += frames.size() * pair.vertex_count();
}

VertexError RunningVertexError::value() const
{
    if (points_ == 0) return {};
    return {square_ / static_cast<double>(points_), largest_square_};
}

VertexError vertex_error(const Pair<float>& pair, Threads threads)
{
    RunningVertexError running(threads);
    running.add(pair);
    return running.value();
}

VertexError vertex_error(const Animation& original, const Animation& distorted, Threads threads)
{
    return vertex_error(pair_of(original, distorted), threads);
}

double rms_error(const Animation& original, const Animation& distorted, Threads threads)
{
    return std::sqrt(vertex_error(original, distorted, threads).mean_square);
}

double max_error(const Animation& original, const Animation& distorted, Threads threads)
{
    return std::sqrt(vertex_error(original, distorted, threads).largest_square);
}

double max_error_relative(const Animation& original, const Animation& distorted, Threads threads)
{
    return largest_in_percent(max_error(original, distorted, threads), body_diagonal(original));
}

double psnr(const Animation& original, const Animation& distorted, Threads threads)
{
    return psnr_of(vertex_error(original, distorted, threads).mean_square, body_diagonal(original));
}

void VertexDistances::add(const Frames& frames)
{
    if (!told_) return;
    std::vector<double> distances(frames.original.cols / 3);
    for (std::size_t f = 0; f < frames.original.rows; ++f) {
        const std::span<const float> original = frames.original.row(f), distorted = frames.distorted.row(f);
        for (std::size_t v = 0; v < distances.size(); ++v) {
            double square = 0;
            for (std::size_t i = 3 * v; i < 3 * v + 3; ++i)
                square += (double{original[i]} - distorted[i]) * (double{original[i]} - distorted[i]);
            distances[v] = std::sqrt(square);
        }
        told_(frame_++, distances);
    }
}

Metric vertex_error_row()
{
    constexpr Invariance but_scale{true, true, false, true}, but_rotation{true, false, true, true};
    static constexpr std::array values{
        Value{"rms", "RMS error", "units", "root of MSE", 0.0, Better::less, but_scale},
        Value{"mse", "MSE", "units^2", "mean squared vertex distance", 0.0, Better::less, but_scale},
        Value{"max_error", "largest error", "units", "largest vertex distance", 0.0, Better::less, but_scale},
        Value{"max_error_relative", "largest error", "% of the body diagonal", "largest vertex distance", 0.0,
              Better::less, but_rotation},
        Value{"psnr", "PSNR", "dB", "10 log10(D^2 / MSE)", unbounded, Better::more, but_rotation},
        Value{"psnr_thesis", "PSNR as in (5.1)", "dB", "thesis (5.1)", -unbounded, Better::less, but_rotation},
    };
    return {.name = "vertex_error",
            .title = "how far vertices are from where they were",
            .values = values,
            .vertex_title = "distance",
            .vertex_unit = "units",
            .start = start_vertex_error};
}

} // namespace meshreel::metrics
