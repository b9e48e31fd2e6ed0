/// A priority queue a level, and the look of each hole in the first frame.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/decimation_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "meshreel/connectivity/decimation.h"

namespace meshreel::connectivity {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The first frame, as the checks of 8.2.1 see it.
class Shape {
public:
    Shape(std::span<const float> positions, double sharpest_angle)
        : positions_(positions), largest_cosine_(std::cos(sharpest_angle))
    {
    }

    /// Closing the hole flips no normal and makes no sharp triangle.
    bool keeps(const Mesh& mesh, std::uint32_t v, const Hole& hole) const
    {
        if (positions_.empty()) return true;
        Vector mean{};
        for (std::uint32_t t : mesh.stars.triangles(v)) {
            const Vector n = normal(mesh.triangles[t]);
            const double length = std::sqrt(dot(n, n));
            for (std::size_t i = 0; i < 3 && length > 0; ++i) mean[i] += n[i] / length;
        }
        return std::none_of(hole.triangles.begin(), hole.triangles.end(),
                            [&](const Triangle& t) { return dot(normal(t), mean) < 0 || sharp(t); });
    }

private:
    Vector edge(std::uint32_t from, std::uint32_t to) const
    {
        Vector all;
        for (std::size_t i = 0; i < 3; ++i)
            all[i] = static_cast<double>(positions_[3ul * to + i]) - positions_[3ul * from + i];
        return all;
    }

    Vector normal(const Triangle& t) const
    {
        const Vector a = edge(t[0], t[1]), b = edge(t[0], t[2]);
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    /// A corner is below the sharpest angle allowed, or has none.
    bool sharp(const Triangle& t) const
    {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector a = edge(t[i], t[(i + 1) % 3]), b = edge(t[i], t[(i + 2) % 3]);
            const double lengths = std::sqrt(dot(a, a) * dot(b, b));
            if (!(lengths > 0) || dot(a, b) > largest_cosine_ * lengths) return true;
        }
        return false;
    }

    std::span<const float> positions_;
    double largest_cosine_;
};

struct Candidate {
    double cost;
    std::uint32_t vertex;

    friend bool operator<(const Candidate& a, const Candidate& b)
    {
        return a.cost < b.cost || (a.cost == b.cost && a.vertex < b.vertex);
    }
};

/// What the removal of every vertex costs, kept from level to level where nothing nearby has changed.
class Costs {
public:
    Costs(std::uint32_t vertex_count, const RemovalCost& cost)
        : cost_(cost), known_(vertex_count), changed_(vertex_count, 1)
    {
    }

    /// Everyone who may go, the cheapest first; the dearest are left out.
    std::vector<Candidate> queue(const Decimator& mesh, const PlanOptions& options)
    {
        std::vector<Candidate> queue;
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            if (!mesh.live(v)) continue;
            if (stale(mesh.mesh(), v)) renew(mesh, v);
            if (known_[v] != never) queue.push_back({known_[v], v});
        }
        std::sort(queue.begin(), queue.end());
        queue.resize(static_cast<std::size_t>(std::ceil(options.considered * static_cast<double>(queue.size()))));
        const auto dear = [&](const Candidate& candidate) { return candidate.cost > options.dearest; };
        queue.erase(std::find_if(queue.begin(), queue.end(), dear), queue.end());
        std::fill(changed_.begin(), changed_.end(), std::uint8_t{0});
        return queue;
    }

    /// Triangles of these change at the level's end.
    void change(std::span<const std::uint32_t> ring)
    {
        for (const std::uint32_t v : ring) changed_[v] = 1;
    }

private:
    static constexpr double never = std::numeric_limits<double>::infinity();

    /// Triangles of v or of a neighbour are new: where they went, v has lost a neighbour or has changed itself.
    bool stale(const Mesh& mesh, std::uint32_t v) const
    {
        const std::span<const Spoke> spokes = mesh.stars.spokes(v);
        return changed_[v] != 0 || std::any_of(spokes.begin(), spokes.end(),
                                               [&](const Spoke& spoke) { return changed_[spoke.vertex] != 0; });
    }

    void renew(const Decimator& mesh, std::uint32_t v)
    {
        known_[v] = mesh.find_hole(v, hole_) ? cost_(mesh.mesh(), v, hole_) : never;
    }

    const RemovalCost& cost_;
    std::vector<double> known_; ///< never: may not go
    std::vector<std::uint8_t> changed_;
    Hole hole_;
};

} // namespace

Plan plan_decimation(const Surface& surface, std::span<const float> first_frame, const RemovalCost& cost,
                     const PlanOptions& options)
{
    const Shape shape(first_frame, options.sharpest_angle);
    Decimator mesh(surface);
    Costs costs(surface.vertex_count, cost);
    Hole hole;
    Plan plan{0, std::vector<std::uint8_t>(surface.vertex_count)};
    const double wanted = options.coarse * surface.vertex_count;
    while (plan.levels < most_levels && mesh.live_count() >= wanted) {
        const std::uint32_t before = mesh.live_count();
        for (const Candidate& candidate : costs.queue(mesh, options)) {
            const std::uint32_t v = candidate.vertex;
            if (!mesh.unlocked(v) || !mesh.find_hole(v, hole) || !mesh.may_go(v, hole)) continue;
            if (!shape.keeps(mesh.mesh(), v, hole)) continue;
            mesh.remove(v, hole);
            costs.change(hole.ring);
            plan.level[v] = static_cast<std::uint8_t>(plan.levels + 1);
        }
        if (mesh.live_count() == before) break;
        mesh.next_level();
        ++plan.levels;
    }
    return plan;
}

} // namespace meshreel::connectivity
