/// Vertices frame by frame and samples interval by interval, each searched for in the grid over the other animation.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/hausdorff_4d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "meshreel/base/random.h"

namespace meshreel::metrics {

namespace {

/// Distances below this part of the largest coordinate are rounding: a 32nd of a millionth of what float32 can tell apart.
constexpr double rounding_part = 0x1p-44;
/// No point of a simplex in three dimensions is farther from all of its corners than this part of its longest edge (Jung).
const double jung_part = std::sqrt(3.0 / 8.0);
constexpr std::size_t tetrahedra_a_task = 4096;
constexpr double most_samples = 100'000'000; ///< an interval: 6 GB
constexpr double fewest_samples = 100;       ///< an interval: a mean over fewer says little

/// Distances with weights, put together in the order they come.
class SpreadSum {
public:
    void add(double distance, double weight)
    {
        largest_ = std::max(largest_, distance);
        if (weight <= 0.0) return;
        sum_ += weight * distance;
        squares_ += weight * (distance * distance);
        weight_ += weight;
    }
    bool any() const { return weight_ > 0.0; }
    DistanceSpread spread() const
    {
        if (!(weight_ > 0.0)) return {largest_, 0.0, 0.0};
        return {largest_, std::min(sum_ / weight_, largest_), std::min(std::sqrt(squares_ / weight_), largest_)};
    }

private:
    double largest_ = 0.0, sum_ = 0.0, squares_ = 0.0, weight_ = 0.0;
};

/// One animation with what the search needs of it.
struct SpaceTimeSide {
    std::vector<Tetrahedron> tetrahedra;
    std::vector<double> axis;
    std::vector<std::uint32_t> used; ///< vertices of triangles
    MovingSurface surface;

    SpaceTimeSide(const MovingMesh& mesh, double units)
        : tetrahedra(interval_tetrahedra(mesh.still.triangles, mesh.still.vertex_count)),
          axis(mesh.still.times_s), surface{mesh.still.vertex_count, tetrahedra, mesh.frames, {}}
    {
        for (double& w : axis) w *= units;
        surface.axis = axis;
        std::vector<bool> in_triangle(mesh.still.vertex_count);
        for (const Triangle& t : mesh.still.triangles)
            for (const std::uint32_t v : t) in_triangle[v] = true;
        for (std::uint32_t v = 0; v < mesh.still.vertex_count; ++v)
            if (in_triangle[v]) used.push_back(v);
    }
    SpaceTimeSide(const SpaceTimeSide&) = delete;

    double largest_coordinate() const
    {
        double largest = 0.0;
        for (const float x : surface.frames.values()) largest = std::max(largest, std::abs(static_cast<double>(x)));
        for (const double w : axis) largest = std::max(largest, std::abs(w));
        return largest;
    }
};

/// What both directions share.
struct Search4d {
    const Hausdorff4dOptions& options;
    double unit;     ///< the body diagonal
    double rounding; ///< distances below are 0
    bool correspond; ///< same triangles and times: vertex v of one is where vertex v of the other should be

    double distance(const NearestQuery& query) const
    {
        const double d = std::sqrt(query.squared);
        return d < rounding ? 0.0 : d / unit;
    }
};

/// The size of each tetrahedron of an interval and a bound of how far its points are.
struct TetrahedronSizes {
    std::vector<double> volume; ///< [3T]; areas of the triangles where the interval has no length
    std::vector<double> reach;  ///< [3T] how far its points may be from its corners
};

double area(const Point4& u, const Point4& v)
{
    const double uv = dot(u, v);
    return std::sqrt(std::max(0.0, dot(u, u) * dot(v, v) - uv * uv)) / 2;
}

void measure_tetrahedron(const MovingSurface& surface, std::size_t interval, std::size_t t, TetrahedronSizes& sizes)
{
    const std::array<Point4, 4> c = surface.corners(interval, t);
    const Point4 n = normal(c[1] - c[0], c[2] - c[0], c[3] - c[0]);
    sizes.volume[t] = std::sqrt(dot(n, n)) / 6;
    if (surface.frames.rows == 1) sizes.volume[t] = t % 3 == 0 ? area(c[1] - c[0], c[2] - c[0]) : 0.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, dot(c[i] - c[j], c[i] - c[j]));
    sizes.reach[t] = jung_part * std::sqrt(longest);
}

/// One direction: the points of one side, searched for on the other.
class DirectedSearch {
public:
    DirectedSearch(const SpaceTimeSide& from, const SpaceTimeSide& to, const Search4d& search)
        : from_(from), to_(to), search_(search), grid_(to.surface, search.options.threads),
          hints_(from.surface.vertex_count, NearestQuery::nothing), now_(from.surface.vertex_count)
    {
        sizes_.volume.resize(from.tetrahedra.size());
        sizes_.reach.resize(from.tetrahedra.size());
    }

    /// Distances of the vertices in a frame; frames in order. [V], body diagonals.
    std::span<const double> look_at_frame(std::size_t frame)
    {
        before_ = now_;
        std::vector<NearestQuery>& queries = queries_;
        queries.clear();
        for (const std::uint32_t v : from_.used)
            queries.push_back({.at = from_.surface.point(frame, v), .nearest = hints_[v]});
        grid_.nearest(queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const std::uint32_t v = from_.used[i];
            hints_[v] = queries[i].nearest;
            now_[v] = search_.distance(queries[i]);
            vertices_.add(now_[v], 1.0);
        }
        if (search_.correspond) look_at_partners(frame);
        return now_;
    }

    /// Samples of the interval that ends with the frame looked at last (of a single frame: of that frame).
    void look_at_interval(std::size_t interval)
    {
        measure(interval);
        for (std::size_t t = 0; t < from_.tetrahedra.size(); ++t) {
            double farthest = 0.0;
            for (const std::uint32_t corner : from_.tetrahedra[t]) farthest = std::max(farthest, distance_at(corner));
            upper_ = std::max(upper_, farthest + sizes_.reach[t] / search_.unit);
        }
        const double volume = choose_samples(interval);
        grid_.nearest(queries_);
        const double weight = volume / std::max<double>(1.0, static_cast<double>(queries_.size()));
        for (const NearestQuery& query : queries_) samples_.add(search_.distance(query), weight);
    }

    Directed4d result() const
    {
        Directed4d result{vertices_.spread(), samples_.spread(), samples_.any(), upper_, grid_.cost()};
        if (search_.correspond) result.upper = std::min(upper_, largest_partner_ / search_.unit);
        result.upper = std::max(result.upper, result.lower());
        return result;
    }

private:
    double distance_at(std::uint32_t corner) const
    {
        const std::uint32_t V = from_.surface.vertex_count;
        return corner < V ? before_[corner] : now_[corner - V];
    }

    /// Tetrahedra of one side that are paired with those of the other by their corners are nowhere farther apart than there.
    void look_at_partners(std::size_t frame)
    {
        for (const std::uint32_t v : from_.used) {
            const Point4 apart = from_.surface.point(frame, v) - to_.surface.point(frame, v);
            largest_partner_ = std::max(largest_partner_, std::sqrt(dot(apart, apart)));
        }
    }

    void measure(std::size_t interval)
    {
        const std::size_t count = from_.tetrahedra.size();
        parallel_for((count + tetrahedra_a_task - 1) / tetrahedra_a_task, search_.options.threads,
                     [&](std::size_t task) {
                         const std::size_t end = std::min(count, (task + 1) * tetrahedra_a_task);
                         for (std::size_t t = task * tetrahedra_a_task; t < end; ++t)
                             measure_tetrahedron(from_.surface, interval, t, sizes_);
                     });
        if (from_.surface.frames.rows == 1) before_ = now_;
    }

    /// Points of the interval, one in each of as many equal parts of its volume. Returns the volume.
    double choose_samples(std::size_t interval)
    {
        queries_.clear();
        double volume = 0.0, passed = 0.0;
        for (const double v : sizes_.volume) volume += v;
        if (!(volume > 0.0) || !std::isfinite(volume)) return 0.0;
        Random random(search_.options.seed + 0x9e3779b97f4a7c15u * (interval + 1));
        const double wanted = std::ceil(search_.options.samples * static_cast<double>(from_.tetrahedra.size() / 3));
        const auto count =
            wanted > 0.0 ? static_cast<std::uint32_t>(std::clamp(wanted, fewest_samples, most_samples)) : 0;
        std::size_t t = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double place = (i + random.uniform()) * (volume / count);
            while (t + 1 < sizes_.volume.size() && passed + sizes_.volume[t] <= place) passed += sizes_.volume[t++];
            queries_.push_back(sample(interval, t, random));
        }
        return volume;
    }

    /// A point anywhere in a tetrahedron, or in the triangle of a single frame.
    NearestQuery sample(std::size_t interval, std::size_t t, Random& random) const
    {
        std::array<double, 3> cuts{random.uniform(), random.uniform(), 1.0};
        if (from_.surface.frames.rows > 1) cuts[2] = random.uniform();
        std::sort(cuts.begin(), cuts.end());
        const std::array<double, 4> weights{cuts[0], cuts[1] - cuts[0], cuts[2] - cuts[1], 1.0 - cuts[2]};
        const std::array<Point4, 4> corners = from_.surface.corners(interval, t);
        NearestQuery query{.nearest = hints_[from_.tetrahedra[t][0] % from_.surface.vertex_count]};
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t c = 0; c < 4; ++c) query.at[c] += weights[i] * corners[i][c];
        return query;
    }

    const SpaceTimeSide &from_, &to_;
    const Search4d& search_;
    SpaceTimeGrid grid_;
    std::vector<std::uint32_t> hints_; ///< [V] the tetrahedron nearest to a vertex when it was looked for last
    std::vector<double> before_, now_; ///< [V] distances in the last two frames
    std::vector<NearestQuery> queries_;
    TetrahedronSizes sizes_;
    SpreadSum vertices_, samples_;
    double upper_ = 0.0, largest_partner_ = 0.0;
};

/// All frames and intervals of one direction.
Directed4d search_direction(const SpaceTimeSide& from, const SpaceTimeSide& to, const Search4d& search,
                            const Hausdorff4dWatch& watch)
{
    DirectedSearch directed(from, to, search);
    const std::size_t F = from.surface.frames.rows;
    for (std::size_t f = 0; f < F; ++f) {
        const std::span<const double> errors = directed.look_at_frame(f);
        if (watch.vertex_errors) watch.vertex_errors(f, errors);
        if (f > 0 || F == 1) directed.look_at_interval(F == 1 ? 0 : f - 1);
        report(watch.progress, "4D distances", static_cast<double>(f + 1) / static_cast<double>(F));
    }
    return directed.result();
}

Progress part_of(const Progress& progress, double from, double to)
{
    if (!progress) return {};
    return [=](std::string_view stage, double fraction) { progress(stage, from + (to - from) * fraction); };
}

/// Holds all frames of both: an animation may be near to another one's at any time.
class Hausdorff4dMeasurement : public Measurement {
public:
    explicit Hausdorff4dMeasurement(const Context& context)
        : original_(context.original), distorted_(context.distorted), vertex_errors_(context.vertex_errors)
    {
        options_.time_constant = context.parameter("time_constant");
        options_.samples = context.parameter("samples");
        options_.seed = static_cast<std::uint64_t>(context.parameter("seed"));
        options_.threads = context.threads;
        original_frames_.reserve(3ul * original_.vertex_count * original_.frame_count());
        distorted_frames_.reserve(3ul * distorted_.vertex_count * distorted_.frame_count());
    }

    void add(const Frames& frames) override
    {
        const std::span<const float> originals = frames.original.values(), distorted = frames.distorted.values();
        original_frames_.insert(original_frames_.end(), originals.begin(), originals.end());
        distorted_frames_.insert(distorted_frames_.end(), distorted.begin(), distorted.end());
    }

    std::vector<double> finish(const Progress& progress) override
    {
        const Watch to_percent{percent_errors(), progress};
        const Hausdorff4d h =
            hausdorff_4d(mesh(original_, original_frames_), mesh(distorted_, distorted_frames_), options_, to_percent);
        const DistanceSpread forward = h.forward.spread(), backward = h.backward.spread(), &own = h.forward.vertices;
        std::vector<double> values{std::max(forward.largest, backward.largest), std::max(forward.mean, backward.mean),
                                   std::max(forward.rms, backward.rms), std::max(h.forward.upper, h.backward.upper)};
        for (const DistanceSpread& spread : {forward, backward, own})
            values.insert(values.end(), {spread.largest, spread.mean, spread.rms});
        for (double& value : values) value *= 100.0;
        return values;
    }

private:
    using Watch = Hausdorff4dWatch;

    static MovingMesh mesh(const Animation& still, const std::vector<float>& positions)
    {
        return {still, {positions.data(), still.frame_count(), 3ul * still.vertex_count}};
    }

    VertexErrors percent_errors()
    {
        if (!vertex_errors_) return {};
        return [this](std::size_t frame, std::span<const double> errors) {
            percent_.assign(errors.begin(), errors.end());
            for (double& error : percent_) error *= 100.0;
            vertex_errors_(frame, percent_);
        };
    }

    const Animation &original_, &distorted_;
    VertexErrors vertex_errors_;
    Hausdorff4dOptions options_;
    std::vector<float> original_frames_, distorted_frames_;
    std::vector<double> percent_;
};

constexpr Invariance moved_and_scaled{true, false, true, true}; // the unit is a box along the axes

constexpr Value value_4d(std::string_view name, std::string_view title)
{
    return {name, title, "%", "thesis 7.1.1", 0.0, Better::less, moved_and_scaled};
}

} // namespace

DistanceSpread Directed4d::spread() const
{
    return sampled ? DistanceSpread{lower(), samples.mean, samples.rms} : vertices;
}

Metric hausdorff_4d_row()
{
    static constexpr std::array values{
        value_4d("hausdorff_4d", "4D Hausdorff distance, at least"),
        value_4d("hausdorff_4d_mean", "the larger of both mean distances"),
        value_4d("hausdorff_4d_rms", "the larger of both root mean squares"),
        value_4d("hausdorff_4d_upper", "4D Hausdorff distance, at most"),
        value_4d("hausdorff_4d_forward", "from the original, largest"),
        value_4d("hausdorff_4d_forward_mean", "from the original, mean"),
        value_4d("hausdorff_4d_forward_rms", "from the original, root mean square"),
        value_4d("hausdorff_4d_backward", "from the distorted one, largest"),
        value_4d("hausdorff_4d_backward_mean", "from the distorted one, mean"),
        value_4d("hausdorff_4d_backward_rms", "from the distorted one, root mean square"),
        value_4d("hausdorff_4d_vertices", "from the original's vertices, largest"),
        value_4d("hausdorff_4d_vertices_mean", "from the original's vertices, mean"),
        value_4d("hausdorff_4d_vertices_rms", "from the original's vertices, root mean square"),
    };
    static constexpr std::array parameters{
        Parameter{"time_constant", "how far in space is as far as a second", "body diagonals a second",
                  usual_time_constant, 1e-6, 1e6},
        Parameter{"samples", "points a triangle and interval; 0: vertices alone", "", 0.5, 0.0, 1000.0},
        Parameter{"seed", "which points", "", 1.0, 0.0, 9007199254740992.0, true},
    };
    return {.name = "hausdorff_4d",
            .title = "distance of the surfaces in space and time",
            .common = Common::nothing,
            .values = values,
            .parameters = parameters,
            .slow = true,
            .vertex_title = "distance in space and time",
            .vertex_unit = "%",
            .start = [](const Context& context) -> std::unique_ptr<Measurement> {
                return std::make_unique<Hausdorff4dMeasurement>(context);
            }};
}

Hausdorff4d hausdorff_4d(const MovingMesh& original, const MovingMesh& distorted, const Hausdorff4dOptions& options,
                         const Hausdorff4dWatch& watch)
{
    const auto first = original.frames.rows > 0 ? original.frames.row(0) : std::span<const float>{};
    const SpaceTimeSide a(original, units_a_second(first, options.time_constant));
    const SpaceTimeSide b(distorted, units_a_second(first, options.time_constant));
    Search4d search{options, units_a_second(first, 1.0), 0.0, false};
    search.rounding = rounding_part * std::max(a.largest_coordinate(), b.largest_coordinate());
    search.correspond = original.still.vertex_count == distorted.still.vertex_count &&
                        original.still.triangles == distorted.still.triangles && a.axis == b.axis;
    const double share = static_cast<double>(original.frames.rows) /
                         static_cast<double>(std::max<std::size_t>(1, original.frames.rows + distorted.frames.rows));
    Hausdorff4d result;
    result.forward = search_direction(a, b, search, {watch.vertex_errors, part_of(watch.progress, 0.0, share)});
    result.backward = search_direction(b, a, search, {{}, part_of(watch.progress, share, 1.0)});
    return result;
}

} // namespace meshreel::metrics
