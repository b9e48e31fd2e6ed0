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

/// The spatial part, frame by frame.
class Spatial {
public:
    Spatial(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options)
        : vertex_count_(vertex_count), options_(options), near_(vertex_count, triangles, options.distance),
          first_run_(near_.run_from(0))
    {
    }

    template <class T>
    void add(const Pair<T>& pair)
    {
        Parts parts{std::vector<double>(pair.frame_count(), 0.0), {}};
        if (options_.vertex_errors) parts.deviations = Matrix<double>(pair.frame_count(), vertex_count_);
        add_run(pair, first_run_, parts);
        for (std::uint32_t v = first_run_.size(); v < vertex_count_;) {
            const NearEdges::Run run = near_.run_from(v);
            add_run(pair, run, parts);
            v += run.size();
        }
        for (std::size_t f = 0; f < parts.sums.size(); ++f) {
            sum_ += parts.sums[f];
            if (options_.vertex_errors) options_.vertex_errors(per_frame_.size(), parts.deviations.row(f));
            per_frame_.push_back(parts.sums[f] / static_cast<double>(vertex_count_));
        }
    }

    double value() const // (7.8)
    {
        return sum_ / (static_cast<double>(vertex_count_) * static_cast<double>(per_frame_.size()));
    }
    const std::vector<double>& per_frame() const { return per_frame_; }

private:
    /// What some frames add.
    struct Parts {
        std::vector<double> sums;  ///< of the deviations of each frame
        Matrix<double> deviations; ///< [N x V], where somebody is told
    };

    template <class T>
    void add_run(const Pair<T>& pair, const NearEdges::Run& run, Parts& parts) const
    {
        parallel_for((pair.frame_count() + lanes - 1) / lanes, options_.threads, [&](std::size_t block) {
            const std::vector<Stretch> all = stretches(pair, near_, block * lanes, options_.absolute_difference);
            const std::size_t first = block * lanes, used = std::min(lanes, pair.frame_count() - first);
            for (std::size_t i = 0; i < run.size(); ++i) {
                const Lanes deviation =
                    deviations(all, {run.edges.data() + run.first[i], run.first[i + 1] - run.first[i]});
                for (std::size_t lane = 0; lane < used; ++lane) parts.sums[first + lane] += deviation[lane];
                for (std::size_t lane = 0; lane < used && options_.vertex_errors; ++lane)
                    parts.deviations(first + lane, run.begin + i) = deviation[lane];
            }
        });
    }

    std::uint32_t vertex_count_;
    StedOptions options_;
    NearEdges near_;
    NearEdges::Run first_run_; ///< mostly the only one
    double sum_ = 0.0;
    std::vector<double> per_frame_;
};

/// The mean over the temporal edges that lie in the window of frames f - w .. f + w with both their ends (7.11).
/// Edge e goes from frame e - 1 to frame e; the one from f - w - 1 is outside. speed[i] is that of edge i + begin.
double window_mean(std::span<const double> speed, std::size_t begin, std::size_t f, std::size_t window)
{
    // DEVIATES (7.11): divides by the number of edges summed, and sums the same on both sides of f, as the authors do.
    const std::size_t first = f >= window ? f - window + 1 : 1, last = std::min(speed.size() + begin, f + window + 1);
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += speed[i - begin];
    return sum / static_cast<double>(last - first);
}

/// Frames that follow others.
template <class T>
struct Motion {
    MatrixView<const T> frames;
    std::span<const double> before; ///< [3V] the frame before them; empty where there is none

    /// Temporal edges that end in one of the frames.
    std::size_t edge_count() const { return frames.rows - (before.empty() && frames.rows > 0 ? 1 : 0); }
};

/// The temporal part. An edge is counted once all edges of its window are known. Edges count from 1: edge e goes from
/// frame e - 1 to frame e.
class Temporal {
public:
    Temporal(std::size_t vertex_count, const StedOptions& options) : options_(options), sums_(vertex_count, 0.0) {}

    template <class T>
    void add(const Pair<T>& pair)
    {
        if (pair.frame_count() == 0) return;
        if (before_original_.empty()) {
            const double diameter = largest_distance(MatrixView<const T>{pair.original.data, sums_.size(), 3}); // (7.9)
            unit_ = diameter > 0.0 ? diameter * diameter : 1.0;
        }
        count(Motion<T>{pair.original, before_original_}, Motion<T>{pair.distorted, before_distorted_},
              options_.window);
        const std::size_t last = pair.frame_count() - 1;
        before_original_.assign(pair.original.row(last).begin(), pair.original.row(last).end());
        before_distorted_.assign(pair.distorted.row(last).begin(), pair.distorted.row(last).end());
    }

    double finish()
    {
        count(Motion<double>{}, Motion<double>{}, 0);
        if (known_ == 0) return 0.0;
        return sum_of(sums_) / (static_cast<double>(sums_.size()) * static_cast<double>(known_)); // (7.13)
    }

private:
    /// Takes in the edges of the frames, and counts all edges known then but the last `waiting`.
    template <class T>
    void count(const Motion<T>& original, const Motion<T>& distorted, std::size_t waiting)
    {
        known_ += original.edge_count();
        const std::size_t ready = std::max(counted_, known_ - std::min(known_, waiting));
        const std::size_t kept = std::min<std::size_t>(known_, 2ul * options_.window - 1);
        Matrix<double> kept_original(sums_.size(), kept), kept_distorted(sums_.size(), kept);
        parallel_for((sums_.size() + vertices_a_block - 1) / vertices_a_block, options_.threads,
                     [&](std::size_t block) {
                         const std::size_t first = block * vertices_a_block,
                                           last = std::min(sums_.size(), first + vertices_a_block);
                         const Matrix<double> speeds = extended(original_, original, first, last),
                                              others = extended(distorted_, distorted, first, last);
                         for (std::size_t v = first; v < last; ++v) {
                             const std::span<const double> speed = speeds.row(v - first), other = others.row(v - first);
                             count_edges(speed, other, ready, sums_[v]);
                             std::ranges::copy(speed.last(kept), kept_original.row(v).begin());
                             std::ranges::copy(other.last(kept), kept_distorted.row(v).begin());
                         }
                     });
        original_ = std::move(kept_original);
        distorted_ = std::move(kept_distorted);
        counted_ = ready;
    }

    void count_edges(std::span<const double> speed, std::span<const double> other, std::size_t ready, double& sum) const
    {
        const std::size_t begin = known_ - speed.size() + 1; // the first edge at hand
        for (std::size_t e = counted_ + 1; e <= ready; ++e)
            sum +=
                std::abs(speed[e - begin] - other[e - begin]) / window_mean(speed, begin, e, options_.window); // (7.12)
    }

    /// Temporal edge lengths (7.10) of vertices first .. last - 1, a row each: those kept, then those of the motion.
    template <class T>
    Matrix<double> extended(const Matrix<double>& kept, const Motion<T>& motion, std::size_t first,
                            std::size_t last) const
    {
        const std::size_t more = motion.edge_count();
        Matrix<double> result(last - first, kept.cols + more);
        for (std::size_t v = first; v < last; ++v) std::ranges::copy(kept.row(v), result.row(v - first).begin());
        for (std::size_t e = 0; e < more; ++e) {
            const std::size_t f = motion.frames.rows - more + e;
            for (std::size_t v = first; v < last; ++v)
                result(v - first, kept.cols + e) = f == 0 ? length(motion.frames.row(0), motion.before, v)
                                                          : length(motion.frames.row(f), motion.frames.row(f - 1), v);
        }
        return result;
    }

    template <class T, class Before>
    double length(std::span<const T> now, std::span<const Before> before, std::size_t v) const
    {
        double square = 0;
        for (std::size_t i = 3 * v; i < 3 * v + 3; ++i)
            square += (double{now[i]} - before[i]) * (double{now[i]} - before[i]);
        return std::sqrt(square / unit_ + options_.frame_distance * options_.frame_distance); // (7.10)
    }

    StedOptions options_;
    double unit_ = 1.0;
    std::vector<double> sums_;                               ///< [V]
    std::size_t known_ = 0, counted_ = 0;                    ///< edges
    Matrix<double> original_, distorted_;                    ///< lengths of the last edges, [V x 2w - 1] at most
    std::vector<double> before_original_, before_distorted_; ///< the last frames, [3V]
};

template <class T>
double measured_spatial(const Pair<T>& pair, const StedOptions& options)
{
    Spatial spatial(static_cast<std::uint32_t>(pair.vertex_count()), pair.triangles, options);
    spatial.add(pair);
    return spatial.value();
}

template <class T>
double measured_temporal(const Pair<T>& pair, const StedOptions& options)
{
    Temporal temporal(pair.vertex_count(), options);
    temporal.add(pair);
    return temporal.finish();
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
    std::vector<double> per_frame() const override { return running_.spatial_per_frame(); }

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
    constexpr Invariance all_four{true, true, true, true}, but_duration{true, true, true, false};
    const StedOptions usual;
    static constexpr std::array values{
        Value{"sted", "STED", "", "thesis (7.14)", 0.0, Better::less, but_duration},
        Value{"sted_spatial", "STED in space", "", "thesis (7.8)", 0.0, Better::less, all_four},
        Value{"sted_temporal", "STED in time", "", "thesis (7.13)", 0.0, Better::less, but_duration},
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
    Spatial spatial;
    Temporal temporal;
    double temporal_weight;
};

RunningSted::RunningSted(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options)
    : parts_(new Parts{Spatial(vertex_count, triangles, options), Temporal(vertex_count, options),
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

const std::vector<double>& RunningSted::spatial_per_frame() const
{
    return parts_->spatial.per_frame();
}

Sted RunningSted::finish()
{
    Sted parts{parts_->spatial.value(), parts_->temporal.finish(), 0.0};
    const double temporal = parts_->temporal_weight * parts.temporal;
    parts.total = std::sqrt(parts.spatial * parts.spatial + temporal * temporal); // (7.14)
    return parts;
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
