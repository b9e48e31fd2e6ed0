/// Stratified samples of faces and edges, in runs that threads share.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/random.h"

namespace meshreel::metrics {

namespace {

constexpr std::size_t sampled_a_run = 1024; ///< triangles, edges or vertices

Point point_of(std::span<const float> positions, std::uint32_t v)
{
    return {positions[3ul * v], positions[3ul * v + 1], positions[3ul * v + 2]};
}

/// Measures one sample after the other; each begins where the one before ended.
class Sampler {
public:
    explicit Sampler(const SurfaceDistance& to) : to_(to) {}

    void measure(const Point& point)
    {
        const auto [squared, place] = to_.nearest(point, place_); // (5.15)
        place_ = place;
        found.largest = std::max(found.largest, squared);
        found.sum += squared;
        ++found.count;
    }

    SampledDistance found;

private:
    const SurfaceDistance& to_;
    SurfaceDistance::Place place_ = 0;
};

/// Calls body(sampler, i) for i = 0 .. count - 1 in runs; sums in their order.
template <class Body>
SampledDistance in_runs(std::size_t count, const SurfaceDistance& to, Threads threads, const Body& body)
{
    std::vector<SampledDistance> runs((count + sampled_a_run - 1) / sampled_a_run);
    parallel_for(runs.size(), threads, [&](std::size_t run) {
        Sampler sampler(to);
        const std::size_t last = std::min(count, (run + 1) * sampled_a_run);
        for (std::size_t i = run * sampled_a_run; i < last; ++i) body(sampler, i);
        runs[run] = sampler.found;
    });
    SampledDistance all;
    for (const SampledDistance& run : runs) all.add(run);
    return all;
}

/// Shares out samples among pieces by their size, and draws them.
class Shares {
public:
    /// sizes: of the pieces, not negative; where all are 0, or too large to be added up, they count as equal.
    Shares(std::vector<double> sizes, const SampleOptions& options)
        : ends_(std::move(sizes)), seed_(Random(options.seed).bits()), count_(options.count),
          offset_(Random(options.seed).uniform())
    {
        double sum = 0;
        for (double& end : ends_) end = sum += end;
        if (sum > 0 && std::isfinite(sum)) return;
        for (std::size_t i = 0; i < ends_.size(); ++i) ends_[i] = static_cast<double>(i + 1);
    }

    /// Calls body(random) for each sample of piece i.
    template <class Body>
    void for_samples(std::size_t i, const Body& body) const
    {
        const std::size_t first = i == 0 ? 0 : samples_before(i), last = samples_before(i + 1);
        if (first == last) return;
        Random random(Random(seed_ + i).bits());
        for (std::size_t k = first; k < last; ++k) body(random);
    }

private:
    /// Sample k falls at (k + offset) / count of the whole.
    std::size_t samples_before(std::size_t pieces) const
    {
        if (pieces == ends_.size()) return count_;
        const auto count = static_cast<double>(count_);
        const double before = std::ceil(ends_[pieces - 1] / ends_.back() * count - offset_);
        return static_cast<std::size_t>(std::clamp(before, 0.0, count));
    }

    std::vector<double> ends_;
    std::uint64_t seed_;
    std::size_t count_;
    double offset_;
};

Point random_point(const TriangleCorners& corners, Random& random)
{
    const auto& [a, b, c] = corners;
    const double root = std::sqrt(random.uniform()), along = random.uniform();
    return plus(a, plus(times(root * (1 - along), minus(b, a)), times(root * along, minus(c, a))));
}

double area_of(const TriangleCorners& corners)
{
    const auto& [a, b, c] = corners;
    const Point normal = cross(minus(b, a), minus(c, a));
    return std::sqrt(dot(normal, normal)) / 2;
}

} // namespace

double SampledDistance::rms() const
{
    return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

void SampledDistance::add(const SampledDistance& other)
{
    largest = std::max(largest, other.largest);
    sum += other.sum;
    count += other.count;
}

SampledDistance sample_faces(const SurfaceDistance& from, const SurfaceDistance& to, const SampleOptions& options)
{
    std::vector<double> areas(from.size());
    for (SurfaceDistance::Place place = 0; place < areas.size(); ++place)
        areas[from.triangle_at(place)] = area_of(from.corners(place));
    const Shares shares(std::move(areas), options);
    return in_runs(from.size(), to, options.threads, [&](Sampler& sampler, std::size_t place) {
        const TriangleCorners corners = from.corners(static_cast<SurfaceDistance::Place>(place));
        shares.for_samples(from.triangle_at(static_cast<SurfaceDistance::Place>(place)),
                           [&](Random& random) { sampler.measure(random_point(corners, random)); });
    });
}

Outline::Outline(std::span<const Triangle> triangles)
{
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            vertices.push_back(t[i]);
            edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
        }
    const auto once = [](auto& list) {
        std::ranges::sort(list);
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    once(vertices);
    once(edges);
}

SampledDistance sample_edges(const Outline& from, std::span<const float> positions, const SurfaceDistance& to,
                             const SampleOptions& options)
{
    std::vector<double> lengths(from.edges.size());
    for (std::size_t e = 0; e < lengths.size(); ++e)
        lengths[e] =
            std::sqrt(squared_distance(point_of(positions, from.edges[e][0]), point_of(positions, from.edges[e][1])));
    const Shares shares(std::move(lengths), options);
    return in_runs(from.edges.size(), to, options.threads, [&](Sampler& sampler, std::size_t e) {
        const Point a = point_of(positions, from.edges[e][0]), b = point_of(positions, from.edges[e][1]);
        shares.for_samples(e, [&](Random& random) { sampler.measure(between(a, b, random.uniform())); });
    });
}

SampledDistance sample_vertices(const Outline& from, std::span<const float> positions, const SurfaceDistance& to,
                                const SampleOptions& options)
{
    return in_runs(from.vertices.size(), to, options.threads,
                   [&](Sampler& sampler, std::size_t i) { sampler.measure(point_of(positions, from.vertices[i])); });
}

} // namespace meshreel::metrics
