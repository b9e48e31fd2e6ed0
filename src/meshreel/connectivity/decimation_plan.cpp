/// A priority queue a level, and the look of each hole in the first frame.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/decimation_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Everyone who may go, the best predicted first; the worst predicted are left out.
std::vector<Candidate> queue_of(const Decimator& mesh, const RemovalCost& cost, double considered)
{
    std::vector<Candidate> queue;
    Hole hole;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.live(v) && mesh.find_hole(v, hole)) queue.push_back({cost(v, hole.ring), v});
    std::sort(queue.begin(), queue.end());
    queue.resize(static_cast<std::size_t>(std::ceil(considered * static_cast<double>(queue.size()))));
    return queue;
}

} // namespace

Plan plan_decimation(const Surface& surface, std::span<const float> first_frame, const RemovalCost& cost,
                     const PlanOptions& options)
{
    const Shape shape(first_frame, options.sharpest_angle);
    Decimator mesh(surface);
    Plan plan{0, std::vector<std::uint8_t>(surface.vertex_count)};
    const double wanted = options.coarse * surface.vertex_count;
    while (plan.levels < most_levels && mesh.live_count() >= wanted) {
        const std::uint32_t before = mesh.live_count();
        Hole hole;
        for (const Candidate& candidate : queue_of(mesh, cost, options.considered)) {
            const std::uint32_t v = candidate.vertex;
            if (!mesh.unlocked(v) || !mesh.find_hole(v, hole) || !mesh.may_go(v, hole)) continue;
            if (!shape.keeps(mesh.mesh(), v, hole)) continue;
            mesh.remove(v, hole);
            plan.level[v] = static_cast<std::uint8_t>(plan.levels + 1);
        }
        if (mesh.live_count() == before) break;
        mesh.next_level();
        ++plan.levels;
    }
    return plan;
}

} // namespace meshreel::connectivity
