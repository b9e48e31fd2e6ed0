/// Collects near edges by walking outwards, ring by ring.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/near_edges.h"

#include "meshreel/mesh/corner_table.h"

namespace meshreel::metrics {

NearEdges::NearEdges(std::uint32_t vertex_count, std::span<const Triangle> triangles, std::uint32_t distance)
    : vertex_count_(vertex_count), distance_(distance), first_at_(vertex_count + 1ul, 0),
      vertex_seen_by_(vertex_count, VertexId::none)
{
    const CornerTable table(vertex_count, triangles);
    edges_.reserve(table.edge_count());
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const Edge edge = table.edge(e);
        edges_.emplace_back(edge.low.value, edge.high.value);
        ++first_at_[edge.low.value + 1ul];
        ++first_at_[edge.high.value + 1ul];
    }
    for (std::size_t v = 1; v < first_at_.size(); ++v) first_at_[v] += first_at_[v - 1];
    edge_at_.resize(2 * edges_.size());
    std::vector<std::uint32_t> place(first_at_.begin(), first_at_.end() - 1);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        edge_at_[place[edges_[e].first]++] = e;
        edge_at_[place[edges_[e].second]++] = e;
    }
    edge_seen_by_.assign(edges_.size(), VertexId::none);
}

void NearEdges::append_near(std::uint32_t v, std::vector<std::uint32_t>& list)
{
    std::vector<std::uint32_t> ring{v}, next_ring;
    vertex_seen_by_[v] = v;
    for (std::uint32_t step = 0; step <= distance_ && !ring.empty(); ++step) {
        next_ring.clear();
        for (std::uint32_t u : ring)
            for (std::uint32_t e : edges_at(u)) {
                if (edge_seen_by_[e] == v) continue;
                edge_seen_by_[e] = v;
                list.push_back(e);
                const std::uint32_t other = edges_[e].first == u ? edges_[e].second : edges_[e].first;
                if (vertex_seen_by_[other] == v) continue;
                vertex_seen_by_[other] = v;
                next_ring.push_back(other);
            }
        ring.swap(next_ring);
    }
}

NearEdges::Run NearEdges::run_from(std::uint32_t begin, std::size_t capacity)
{
    Run run;
    run.begin = begin;
    for (std::uint32_t v = begin; v < vertex_count_ && run.edges.size() < capacity; ++v) {
        append_near(v, run.edges);
        run.first.push_back(run.edges.size());
    }
    return run;
}

} // namespace meshreel::metrics
