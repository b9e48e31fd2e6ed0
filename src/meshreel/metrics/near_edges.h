/// The edges near each vertex, for measures that look at neighbourhoods.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::metrics {

/// The different edges of a triangle list, and for each vertex those at most `distance` edges away. Lists are made for
/// a run of vertices at a time, so that vertices of huge valence do not fill the memory.
class NearEdges {
public:
    NearEdges(std::uint32_t vertex_count, std::span<const Triangle> triangles, std::uint32_t distance);

    /// [E] lower and higher vertex.
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges() const { return edges_; }

    /// Lists of a run of vertices: edges[first[i]] .. edges[first[i + 1]] are near vertex `begin + i`.
    struct Run {
        std::uint32_t begin = 0;
        std::vector<std::size_t> first{0};
        std::vector<std::uint32_t> edges;
        std::uint32_t size() const { return static_cast<std::uint32_t>(first.size() - 1); }
    };
    /// The run from vertex `begin` to where its lists fill `capacity` entries (it may go beyond by its last list).
    Run run_from(std::uint32_t begin, std::size_t capacity = std::size_t{1} << 24);

private:
    std::span<const std::uint32_t> edges_at(std::uint32_t v) const
    {
        return {edge_at_.data() + first_at_[v], first_at_[v + 1ul] - first_at_[v]};
    }
    void append_near(std::uint32_t v, std::vector<std::uint32_t>& list);

    std::uint32_t vertex_count_, distance_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
    std::vector<std::uint32_t> first_at_, edge_at_;            // edges at each vertex
    std::vector<std::uint32_t> vertex_seen_by_, edge_seen_by_; // the vertex whose list was made when they were last met
};

} // namespace meshreel::metrics
