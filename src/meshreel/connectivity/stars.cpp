/// Buckets by vertex; the spokes in each sorted and counted.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/stars.h"

#include <algorithm>

#include "meshreel/connectivity/adjacency.h"

namespace meshreel::connectivity {

Stars::Stars(std::uint32_t vertex_count, std::span<const Triangle> triangles)
    : star_begin_(vertex_count + 1ul), stuck_(vertex_count)
{
    for (const Triangle& t : triangles)
        for (std::uint32_t v : t) ++star_begin_[v + 1ul];
    for (std::uint32_t v = 0; v < vertex_count; ++v) star_begin_[v + 1ul] += star_begin_[v];
    star_.resize(star_begin_.back());
    std::vector<std::uint32_t> end(star_begin_.begin(), star_begin_.end() - 1);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t v : triangles[t]) {
            star_[end[v]++] = t;
            if (degenerate(triangles[t])) stuck_[v] = 1;
        }
    collect_spokes(triangles);
}

void Stars::collect_spokes(std::span<const Triangle> triangles)
{
    spoke_begin_.assign(1, 0);
    spokes_.reserve(star_.size() + star_.size() / 8);
    std::vector<std::uint32_t> others;
    for (std::uint32_t v = 0; v < stuck_.size(); ++v) {
        others.clear();
        for (std::uint32_t t : this->triangles(v))
            for (std::uint32_t other : triangles[t])
                if (other != v && !degenerate(triangles[t])) others.push_back(other);
        std::ranges::sort(others);
        const std::size_t first = spokes_.size();
        for (std::uint32_t other : others) {
            if (spokes_.size() == first || spokes_.back().vertex != other) spokes_.push_back({other, 0});
            ++spokes_.back().count;
        }
        spoke_begin_.push_back(static_cast<std::uint32_t>(spokes_.size()));
    }
}

std::uint32_t Stars::triangles_at(std::uint32_t a, std::uint32_t b) const
{
    const std::span<const Spoke> all = spokes(a);
    const auto found =
        std::lower_bound(all.begin(), all.end(), b, [](const Spoke& side, std::uint32_t v) { return side.vertex < v; });
    return found != all.end() && found->vertex == b ? found->count : 0;
}

} // namespace meshreel::connectivity
