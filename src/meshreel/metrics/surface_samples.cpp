/// Stratified samples of faces and edges, in runs that threads share.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/random.h"

namespace meshreel::metrics {

namespace {

constexpr std::size_t samples_a_run = 4096;

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

/// Calls body(sampler, first, last, random) for runs of 0 .. count - 1; sums in their order.
template <class Body>
SampledDistance in_runs(const SurfaceDistance& to, const SampleOptions& options, const Body& body)
{
    std::vector<SampledDistance> runs((options.count + samples_a_run - 1) / samples_a_run);
    parallel_for(runs.size(), options.threads, [&](std::size_t run) {
        Sampler sampler(to);
        Random random(Random(options.seed + run).bits());
        body(sampler, run * samples_a_run, std::min(options.count, (run + 1) * samples_a_run), random);
        runs[run] = sampler.found;
    });
    SampledDistance all;
    for (const SampledDistance& run : runs) all.add(run);
    return all;
}

/// Shares out samples among pieces by their size: where the k-th of them falls.
class Shares {
public:
    /// sizes: of the pieces, not negative; where all are 0, or too large to be added up, they count as equal.
    explicit Shares(std::vector<double> sizes) : ends_(std::move(sizes))
    {
        double sum = 0;
        for (double& end : ends_) end = sum += end;
        if (sum > 0 && std::isfinite(sum)) return;
        for (std::size_t i = 0; i < ends_.size(); ++i) ends_[i] = static_cast<double>(i + 1);
    }

    /// The piece at a share of the whole, 0 <= share < 1. @param from  no piece before this one is meant
    std::size_t piece(double share, std::size_t from) const
    {
        const double at = share * ends_.back();
        if (from < ends_.size() && at < ends_[from]) return from;
        const auto found = std::upper_bound(ends_.begin() + from, ends_.end(), at);
        return found == ends_.end() ? ends_.size() - 1 : static_cast<std::size_t>(found - ends_.begin());
    }

private:
    std::vector<double> ends_;
};

Point random_point(const Corners& corners, Random& random)
{
    const auto& [a, b, c] = corners;
    const double root = std::sqrt(random.uniform()), along = random.uniform();
    return plus(a, plus(times(root * (1 - along), minus(b, a)), times(root * along, minus(c, a))));
}

double area_of(const Corners& corners)
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
    for (SurfaceDistance::Place place = 0; place < areas.size(); ++place) areas[place] = area_of(from.corners(place));
    const Shares shares(std::move(areas));
    return in_runs(to, options, [&](Sampler& sampler, std::size_t first, std::size_t last, Random& random) {
        std::size_t face = 0;
        for (std::size_t k = first; k < last; ++k) {
            const double share = (static_cast<double>(k) + random.uniform()) / static_cast<double>(options.count);
            face = shares.piece(share, face);
            sampler.measure(random_point(from.corners(static_cast<SurfaceDistance::Place>(face)), random));
        }
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
    const Shares shares(std::move(lengths));
    return in_runs(to, options, [&](Sampler& sampler, std::size_t first, std::size_t last, Random& random) {
        std::size_t edge = 0;
        for (std::size_t k = first; k < last; ++k) {
            const double share = (static_cast<double>(k) + random.uniform()) / static_cast<double>(options.count);
            edge = shares.piece(share, edge);
            const auto [a, b] = from.edges[edge];
            sampler.measure(between(point_of(positions, a), point_of(positions, b), random.uniform()));
        }
    });
}

SampledDistance sample_vertices(const Outline& from, std::span<const float> positions, const SurfaceDistance& to,
                                const SampleOptions& options)
{
    SampleOptions each = options;
    each.count = from.vertices.size();
    return in_runs(to, each, [&](Sampler& sampler, std::size_t first, std::size_t last, Random&) {
        for (std::size_t k = first; k < last; ++k) sampler.measure(point_of(positions, from.vertices[k]));
    });
}

} // namespace meshreel::metrics
