/// STED from its two parts.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/sted.h"

#include <array>
#include <cmath>

#include "meshreel/metrics/sted_spatial.h"
#include "meshreel/metrics/sted_temporal.h"

namespace meshreel::metrics {

namespace {

double hypotenuse(double spatial, double temporal, double weight)
{
    return std::sqrt(spatial * spatial + weight * temporal * (weight * temporal)); // (7.14)
}

template <class T>
double measured_spatial(const Pair<T>& pair, const StedOptions& options)
{
    SpatialSted spatial(static_cast<std::uint32_t>(pair.vertex_count()), pair.triangles, options);
    spatial.add(pair);
    return spatial.value();
}

template <class T>
double measured_temporal(const Pair<T>& pair, const StedOptions& options)
{
    TemporalSted temporal(pair.vertex_count(), options);
    temporal.add(pair);
    temporal.finish();
    return temporal.value();
}

template <class T>
Sted measured_sted(const Pair<T>& pair, const StedOptions& options)
{
    RunningSted running(static_cast<std::uint32_t>(pair.vertex_count()), pair.triangles, options);
    running.add(pair);
    return running.finish();
}

class StedMeasurement : public Measurement {
public:
    explicit StedMeasurement(const Context& context)
        : triangles_(context.original.triangles), running_(context.original.vertex_count, triangles_, options(context))
    {
    }

    void add(const Frames& frames) override
    {
        running_.add(Pair<float>{frames.original, frames.distorted, triangles_});
    }
    std::vector<double> finish(const Progress&) override
    {
        const Sted sted = running_.finish();
        return {sted.total, sted.spatial, sted.temporal};
    }
    std::vector<double> per_frame() const override { return running_.per_frame(); }

private:
    static StedOptions options(const Context& context)
    {
        return {.distance = static_cast<std::uint32_t>(context.parameter("distance")),
                .window = static_cast<std::uint32_t>(context.parameter("window")),
                .frame_distance = context.parameter("frame_distance"),
                .temporal_weight = context.parameter("temporal_weight"),
                .absolute_difference = context.parameter("absolute_difference") != 0.0,
                .threads = context.threads,
                .vertex_errors = context.vertex_errors};
    }

    std::span<const Triangle> triangles_;
    RunningSted running_;
};

std::unique_ptr<Measurement> start_sted(const Context& context)
{
    return std::make_unique<StedMeasurement>(context);
}

} // namespace

Metric sted_row()
{
    constexpr Invariance all_four{true, true, true, true};
    const StedOptions usual;
    static constexpr std::array values{
        Value{"sted", "STED", "", "thesis (7.14)", 0.0, Better::less, all_four},
        Value{"sted_spatial", "STED in space", "", "thesis (7.8)", 0.0, Better::less, all_four},
        Value{"sted_temporal", "STED in time", "", "thesis (7.13)", 0.0, Better::less, all_four},
    };
    static const std::array parameters{
        Parameter{"distance", "how many edges away an edge counts as near", "edges",
                  static_cast<double>(usual.distance), 0, 1e3, true},
        Parameter{"window", "frames on either side that a speed is averaged over", "frames",
                  static_cast<double>(usual.window), 1, 1e6, true},
        Parameter{"frame_distance", "the time between two frames", "body sizes", usual.frame_distance, 1e-9, 1e9},
        Parameter{"temporal_weight", "what the temporal part counts", "", usual.temporal_weight, 0, 1e9},
        Parameter{"absolute_difference", "1: (7.5) as printed, without the sign", "", 0, 0, 1, true},
    };
    return {.name = "sted",
            .title = "spatio-temporal edge difference",
            .values = values,
            .parameters = parameters,
            .vertex_title = "deviation of edge lengths",
            .start = start_sted};
}

struct RunningSted::Parts {
    SpatialSted spatial;
    TemporalSted temporal;
    double temporal_weight;
};

RunningSted::RunningSted(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options)
    : parts_(new Parts{SpatialSted(vertex_count, triangles, options), TemporalSted(vertex_count, options),
                       options.temporal_weight})
{
}

RunningSted::~RunningSted() = default;

void RunningSted::add(const Pair<float>& frames)
{
    parts_->spatial.add(frames);
    parts_->temporal.add(frames);
}
void RunningSted::add(const Pair<double>& frames)
{
    parts_->spatial.add(frames);
    parts_->temporal.add(frames);
}

std::vector<double> RunningSted::per_frame() const
{
    std::vector<double> all = parts_->spatial.per_frame();
    for (std::size_t f = 0; f < all.size(); ++f)
        all[f] = hypotenuse(all[f], parts_->temporal.per_frame()[f], parts_->temporal_weight);
    return all;
}

Sted RunningSted::finish()
{
    parts_->temporal.finish();
    const double spatial = parts_->spatial.value(), temporal = parts_->temporal.value();
    return {spatial, temporal, hypotenuse(spatial, temporal, parts_->temporal_weight)};
}

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
