/// Frames are measured side by side; of each the two surfaces get a tree, then both directions are bounded or sampled.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/hausdorff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "meshreel/metrics/surface_samples.h"

namespace meshreel::metrics {

/// What of a surface does not move.
struct SurfacePair::Side {
    Side(std::span<const Triangle> given, std::uint32_t vertex_count)
        : triangles(given.begin(), given.end()), outline((add_points(vertex_count), triangles))
    {
    }

    std::vector<Triangle> triangles; ///< of a surface without any: each vertex thrice
    Outline outline;

private:
    void add_points(std::uint32_t vertex_count)
    {
        if (!triangles.empty()) return;
        for (std::uint32_t v = 0; v < vertex_count; ++v) triangles.push_back({v, v, v});
    }
};

namespace {

constexpr std::size_t least_samples = 1000;
constexpr double usual_tolerance = 1e-11; ///< body diagonals
constexpr double not_bounded = std::numeric_limits<double>::infinity();

/// One direction of a frame.
struct OneWay {
    SurfaceFrame from;
    const SurfaceDistance& to;
    const Outline& outline; ///< of `from`
    bool same_triangles;
};

void vertex_distances(const OneWay& way, std::span<double> distances)
{
    SurfaceDistance::Place guess = 0;
    for (std::size_t v = 0; v < distances.size(); ++v) {
        const std::span<const float> x = way.from.positions.subspan(3 * v, 3);
        const auto [squared, place] = way.to.nearest({x[0], x[1], x[2]}, guess);
        guess = place;
        distances[v] = std::sqrt(squared);
    }
}

OneSided sampled(const OneWay& way, const SampleOptions& options, std::span<double> vertices)
{
    const SampledDistance faces = sample_faces(way.from.tree, way.to, options);
    SampledDistance all = faces;
    all.add(sample_edges(way.outline, way.from.positions, way.to, options));
    all.add(sample_vertices(way.outline, way.from.positions, way.to, options));
    vertex_distances(way, vertices);
    return {{std::sqrt(all.largest), not_bounded, 0}, faces.rms()};
}

OneSided one_sided(const OneWay& way, const HausdorffOptions& options, std::span<double> vertices)
{
    if (way.from.tree.empty() || way.to.empty()) {
        const double distance = way.from.tree.empty() ? 0.0 : not_bounded;
        std::ranges::fill(vertices, distance);
        return {{distance, distance, 0}, distance};
    }
    const std::size_t usual = std::max(least_samples, way.from.tree.size());
    const SampleOptions samples{options.samples > 0 ? options.samples : usual, options.seed, options.threads};
    if (options.sampling) return sampled(way, samples, vertices);
    const BoundOptions bounds{options.tolerance, options.most_cuts, way.same_triangles, vertices};
    return {bound_distance(way.from, way.to, bounds), sample_faces(way.from.tree, way.to, samples).rms()};
}

class HausdorffMeasurement : public Measurement {
public:
    explicit HausdorffMeasurement(const Context& context)
        : pair_(context.original.triangles, context.original.vertex_count, context.distorted.triangles,
                context.distorted.vertex_count),
          vertex_errors_(context.vertex_errors), threads_(context.threads), tolerance_(context.parameter("tolerance"))
    {
        options_.most_cuts = static_cast<std::size_t>(context.parameter("most_cuts"));
        options_.samples = static_cast<std::size_t>(context.parameter("samples"));
        options_.seed = static_cast<std::uint64_t>(context.parameter("seed"));
        options_.sampling = context.parameter("sampling") != 0.0;
    }

    void add(const Frames& frames) override
    {
        const std::size_t first = found_.size(), count = frames.original.rows;
        if (first == 0 && count > 0 && frames.original.cols > 0)
            options_.tolerance = tolerance_ * body_diagonal(frames.original.row(0));
        found_.resize(first + count);
        Matrix<double> vertices(vertex_errors_ ? count : 0, frames.original.cols / 3);
        HausdorffOptions options = options_;
        options.threads = {std::max(1u, threads_.used() / static_cast<unsigned>(std::max<std::size_t>(count, 1)))};
        parallel_for(count, threads_, [&](std::size_t f) {
            found_[first + f] = pair_.measure(frames.original.row(f), frames.distorted.row(f), options,
                                              vertex_errors_ ? vertices.row(f) : std::span<double>());
        });
        for (std::size_t f = 0; f < vertices.rows; ++f) vertex_errors_(first + f, vertices.row(f));
    }

    std::vector<double> finish(const Progress&) override
    {
        return {mean_of([](const FrameHausdorff& frame) { return frame.lower(); }),
                mean_of([](const FrameHausdorff& frame) { return frame.upper(); }),
                mean_of([](const FrameHausdorff& frame) { return frame.forward.hausdorff.lower; }),
                mean_of([](const FrameHausdorff& frame) { return frame.backward.hausdorff.lower; }),
                largest_of([](const FrameHausdorff& frame) { return frame.lower(); }),
                largest_of([](const FrameHausdorff& frame) { return frame.upper(); }),
                mean_of([](const FrameHausdorff& frame) { return frame.rms(); }),
                mean_of([](const FrameHausdorff& frame) { return frame.forward.rms; }),
                mean_of([](const FrameHausdorff& frame) { return frame.backward.rms; })};
    }

    std::vector<double> per_frame() const override
    {
        std::vector<double> lower(found_.size());
        std::ranges::transform(found_, lower.begin(), &FrameHausdorff::lower);
        return lower;
    }

private:
    template <class Number>
    double mean_of(const Number& number) const
    {
        double sum = 0;
        for (const FrameHausdorff& frame : found_) sum += number(frame);
        return found_.empty() ? 0.0 : sum / static_cast<double>(found_.size());
    }

    template <class Number>
    double largest_of(const Number& number) const
    {
        double most = 0;
        for (const FrameHausdorff& frame : found_) most = std::max(most, number(frame));
        return most;
    }

    SurfacePair pair_;
    VertexErrors vertex_errors_;
    Threads threads_;
    double tolerance_; ///< body diagonals of the first original frame
    HausdorffOptions options_;
    std::vector<FrameHausdorff> found_;
};

std::unique_ptr<Measurement> start_hausdorff(const Context& context)
{
    return std::make_unique<HausdorffMeasurement>(context);
}

} // namespace

double FrameHausdorff::lower() const
{
    return std::max(forward.hausdorff.lower, backward.hausdorff.lower); // (5.17)
}

double FrameHausdorff::upper() const
{
    return std::max(forward.hausdorff.upper, backward.hausdorff.upper);
}

double FrameHausdorff::rms() const
{
    return std::max(forward.rms, backward.rms);
}

SurfacePair::SurfacePair(std::span<const Triangle> original, std::uint32_t vertex_count,
                         std::span<const Triangle> distorted, std::uint32_t distorted_vertex_count)
    : original_(new Side(original, vertex_count)), distorted_(new Side(distorted, distorted_vertex_count)),
      same_triangles_(original_->triangles == distorted_->triangles)
{
}

SurfacePair::~SurfacePair() = default;

FrameHausdorff SurfacePair::measure(std::span<const float> original, std::span<const float> distorted,
                                    const HausdorffOptions& options, std::span<double> vertices) const
{
    if (same_triangles_ && std::ranges::equal(original, distorted)) {
        std::ranges::fill(vertices, 0.0);
        return {};
    }
    const SurfaceDistance one(original_->triangles, original), other(distorted_->triangles, distorted);
    const SurfaceFrame from{original_->triangles, original, one}, back{distorted_->triangles, distorted, other};
    return {one_sided({from, other, original_->outline, same_triangles_}, options, vertices),
            one_sided({back, one, distorted_->outline, same_triangles_}, options, {})};
}

Metric hausdorff_row()
{
    static constexpr Invariance but_scale{true, true, false, true};
    const HausdorffOptions usual;
    static constexpr auto value = [](std::string_view name, std::string_view title, std::string_view source) {
        return Value{name, title, "units", source, 0.0, Better::less, but_scale};
    };
    static constexpr std::array values{
        value("hausdorff", "Hausdorff distance, mean over the frames", "thesis (5.17), 5.4"),
        value("hausdorff_upper", "no more than, by an upper bound in each frame", "thesis (5.17)"),
        value("hausdorff_forward", "from the original to the distorted surface, mean", "thesis (5.16)"),
        value("hausdorff_backward", "from the distorted to the original surface, mean", "thesis (5.16)"),
        value("hausdorff_max", "largest Hausdorff distance of a frame", "thesis (5.17)"),
        value("hausdorff_max_upper", "no more than, by an upper bound", "thesis (5.17)"),
        value("surface_rms", "RMS distance of the surfaces, mean over the frames", "thesis 5.4, METRO"),
        value("surface_rms_forward", "from the original to the distorted surface", "thesis 5.4, METRO"),
        value("surface_rms_backward", "from the distorted to the original surface", "thesis 5.4, METRO"),
    };
    static const std::array parameters{
        Parameter{"tolerance", "what the bounds of a frame may differ by", "body diagonals", usual_tolerance, 0, 1},
        Parameter{"most_cuts", "work in a frame and direction after which they may differ more", "cuts",
                  static_cast<double>(usual.most_cuts), 0, 1e8, true},
        Parameter{"samples", "samples in a frame and direction; 0: as many as triangles, but a thousand at least",
                  "samples", static_cast<double>(usual.samples), 0, 1e9, true},
        Parameter{"seed", "of the samples", "", static_cast<double>(usual.seed), 0, 1e15, true},
        Parameter{"sampling", "1: no bounds, but vertices, edges and faces sampled, as METRO", "", 0, 0, 1, true},
    };
    return {.name = "hausdorff",
            .title = "distance of the surfaces, frame by frame",
            .common = Common::frames,
            .values = values,
            .parameters = parameters,
            .slow = true,
            .vertex_title = "distance to the other surface",
            .vertex_unit = "units",
            .start = start_hausdorff};
}

} // namespace meshreel::metrics
