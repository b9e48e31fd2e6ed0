/// Levels, locks and claims; then the way back as rows.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/decimation.h"

#include <algorithm>

#include "meshreel/connectivity/adjacency.h"
#include "meshreel/connectivity/trace.h"

namespace meshreel::connectivity {

namespace {

/// A vertex that went, and its neighbours then.
struct Removed {
    std::uint32_t vertex;
    std::vector<std::uint32_t> ring;
};

/// By level, by the degree that is left, by neighbours that cannot go any more.
std::uint32_t removal_context(const Decimator& mesh, int level, const Hole& hole)
{
    const auto settled =
        std::count_if(hole.ring.begin(), hole.ring.end(), [&](std::uint32_t r) { return !mesh.unlocked(r); });
    const std::size_t degree = std::clamp<std::size_t>(hole.ring.size(), 3, 8) - 3;
    const std::size_t row = static_cast<std::size_t>(std::min(level, 3) - 1) * 6 + degree;
    return static_cast<std::uint32_t>(row * 4) + static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(settled, 3));
}

std::vector<Removed> take_level(Decimator& mesh, int level, const Goes& goes)
{
    std::vector<Removed> gone;
    Hole hole;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.unlocked(v) || !mesh.find_hole(v, hole) || !mesh.may_go(v, hole)) continue;
        if (!goes(static_cast<std::uint32_t>(level), v, removal_context(mesh, level, hole))) continue;
        mesh.remove(v, hole);
        gone.push_back({v, hole.ring});
    }
    mesh.next_level();
    return gone;
}

/// The coarsest mesh, its vertices in the order of its own trace.
void trace_coarsest(const Decimator& mesh, Decimation& result)
{
    std::vector<std::uint32_t> live, number(mesh.vertex_count(), none);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.live(v)) continue;
        number[v] = static_cast<std::uint32_t>(live.size());
        live.push_back(v);
    }
    std::vector<Triangle> triangles(mesh.mesh().triangles.begin(), mesh.mesh().triangles.end());
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) v = number[v];
    Trace traced = trace(static_cast<std::uint32_t>(live.size()), triangles);
    result.gates = std::move(traced.surface.gates);
    result.coarsest = std::move(traced.surface.triangles);
    for (std::uint32_t v : traced.vertex_of) result.vertex_of.push_back(live[v]);
    result.row_counts.push_back(static_cast<std::uint32_t>(live.size()));
}

/// Rows of what went, the last level first.
void add_finer(const std::vector<std::vector<Removed>>& levels, Decimation& result)
{
    std::vector<std::uint32_t> row_of(result.vertex_of.size());
    for (const std::vector<Removed>& level : levels) row_of.resize(row_of.size() + level.size());
    const auto number = [&](std::uint32_t row) { row_of[result.vertex_of[row]] = row; };
    for (std::uint32_t row = 0; row < result.vertex_of.size(); ++row) number(row);
    result.ring_begin.push_back(0);
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        for (const Removed& gone : *level) {
            result.vertex_of.push_back(gone.vertex);
            number(static_cast<std::uint32_t>(result.vertex_of.size() - 1));
            for (std::uint32_t neighbour : gone.ring) result.rings.push_back(row_of[neighbour]);
            result.ring_begin.push_back(static_cast<std::uint32_t>(result.rings.size()));
        }
        result.row_counts.push_back(static_cast<std::uint32_t>(result.vertex_of.size()));
    }
}

} // namespace

Decimator::Decimator(const Surface& surface)
    : triangles_(adjacency(surface.vertex_count, surface.triangles).triangles),
      stars_(surface.vertex_count, triangles_), state_(surface.vertex_count), live_count_(surface.vertex_count)
{
}

bool Decimator::may_go(std::uint32_t v, const Hole& hole) const
{
    return unlocked(v) && std::none_of(hole.claims.begin(), hole.claims.end(),
                                       [&](const Edge& claim) { return claims_.count(claim) != 0; });
}

void Decimator::remove(std::uint32_t v, const Hole& hole)
{
    state_[v] = State::gone;
    for (std::uint32_t neighbour : hole.ring) state_[neighbour] = State::locked;
    claims_.insert(hole.claims.begin(), hole.claims.end());
    patches_.push_back({v, hole.triangles});
    --live_count_;
}

void Decimator::next_level()
{
    const auto removed = [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return !live(v); });
    };
    triangles_.erase(std::remove_if(triangles_.begin(), triangles_.end(), removed), triangles_.end());
    std::ranges::sort(patches_, [](const Patch& a, const Patch& b) { return a.vertex < b.vertex; });
    for (const Patch& patch : patches_)
        triangles_.insert(triangles_.end(), patch.triangles.begin(), patch.triangles.end());
    patches_.clear();
    claims_.clear();
    std::replace(state_.begin(), state_.end(), State::locked, State::unlocked);
    stars_ = Stars(vertex_count(), triangles_);
}

Decimation decimate(const Surface& surface, int levels, const Goes& goes)
{
    Decimator mesh(surface);
    std::vector<std::vector<Removed>> gone;
    for (int level = 1; level <= levels; ++level) gone.push_back(take_level(mesh, level, goes));
    Decimation result;
    trace_coarsest(mesh, result);
    add_finer(gone, result);
    return result;
}

std::uint64_t decimation_bytes(const Surface& surface)
{
    return 160 * std::uint64_t{surface.vertex_count} + 240 * std::uint64_t{surface.triangles.size()};
}

} // namespace meshreel::connectivity
