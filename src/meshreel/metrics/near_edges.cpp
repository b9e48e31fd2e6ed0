/// Collects near edges by walking outwards, ring by ring.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/near_edges.h"

#include <algorithm>

#include "meshreel/base/id.h"

namespace meshreel::metrics {

namespace {

using EdgeList = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Pairs of vertices, lower first, that a triangle with three different vertices joins; rising, each once.
EdgeList edges_of(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    std::vector<std::size_t> first(vertex_count + 1ul, 0);
    const auto for_sides = [&](const auto& visit) {
        for (const auto& [a, b, c] : triangles) {
            if (a == b || b == c || c == a) continue;
            visit(std::min(a, b), std::max(a, b));
            visit(std::min(b, c), std::max(b, c));
            visit(std::min(c, a), std::max(c, a));
        }
    };
    for_sides([&](std::uint32_t low, std::uint32_t) { ++first[low + 1ul]; });
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::uint32_t> highs(first.back());
    std::vector<std::size_t> place(first.begin(), first.end() - 1);
    for_sides([&](std::uint32_t low, std::uint32_t high) { highs[place[low]++] = high; });
    EdgeList edges;
    edges.reserve(highs.size() / 2 + 1);
    for (std::uint32_t low = 0; low < vertex_count; ++low) {
        const std::span<std::uint32_t> at(highs.data() + first[low], first[low + 1ul] - first[low]);
        std::sort(at.begin(), at.end());
        for (std::size_t i = 0; i < at.size(); ++i)
            if (i == 0 || at[i] != at[i - 1]) edges.emplace_back(low, at[i]);
    }
    return edges;
}

} // namespace

NearEdges::NearEdges(std::uint32_t vertex_count, std::span<const Triangle> triangles, std::uint32_t distance)
    : vertex_count_(vertex_count), distance_(distance), first_at_(vertex_count + 1ul, 0),
      star_of_(vertex_count, VertexId::none)
{
    edges_ = edges_of(vertex_count, triangles);
    for (const auto& [a, b] : edges_) {
        ++first_at_[a + 1ul];
        ++first_at_[b + 1ul];
    }
    for (std::size_t v = 1; v < first_at_.size(); ++v) first_at_[v] += first_at_[v - 1];
    edge_at_.resize(2 * edges_.size());
    other_at_.resize(2 * edges_.size());
    std::vector<std::uint32_t> place(first_at_.begin(), first_at_.end() - 1);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        const auto [a, b] = edges_[e];
        edge_at_[place[a]] = edge_at_[place[b]] = e;
        other_at_[place[a]++] = b;
        other_at_[place[b]++] = a;
    }
}

/// The stars are those of all vertices at most `distance_` edges away but v itself, whose edges they have already; at
/// distance 0 that of v.
void NearEdges::append_near(std::uint32_t v, Run& run)
{
    const std::size_t first = run.stars.size();
    run.stars.push_back(v);
    star_of_[v] = v;
    for (std::size_t begin = first, step = 0; step < distance_ && begin < run.stars.size(); ++step) {
        const std::size_t end = run.stars.size();
        for (; begin < end; ++begin)
            for (std::uint32_t i = first_at_[run.stars[begin]]; i < first_at_[run.stars[begin] + 1ul]; ++i) {
                const std::uint32_t other = other_at_[i];
                if (star_of_[other] == v) continue;
                star_of_[other] = v;
                run.stars.push_back(other);
            }
    }
    if (distance_ > 0) {
        star_of_[v] = VertexId::none;
        run.stars.erase(run.stars.begin() + static_cast<std::ptrdiff_t>(first));
    }
    for (std::size_t s = first; s < run.stars.size(); ++s)
        for (std::uint32_t i = first_at_[run.stars[s]]; i < first_at_[run.stars[s] + 1ul]; ++i)
            if (other_at_[i] > run.stars[s] && star_of_[other_at_[i]] == v) run.inner.push_back(edge_at_[i]);
}

NearEdges::Run NearEdges::run_from(std::uint32_t begin, std::size_t capacity)
{
    Run run;
    run.begin = begin;
    for (std::uint32_t v = begin; v < vertex_count_ && run.stars.size() + run.inner.size() < capacity; ++v) {
        append_near(v, run);
        run.first_star.push_back(run.stars.size());
        run.first_inner.push_back(run.inner.size());
    }
    return run;
}

} // namespace meshreel::metrics
