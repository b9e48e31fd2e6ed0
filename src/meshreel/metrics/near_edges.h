/// The edges near each vertex, for measures that look at neighbourhoods.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::metrics {

/// The different edges of a triangle list, and for each vertex those at vertices at most `distance` edges away. Lists are
/// made for a run of vertices at a time, so that wide neighbourhoods do not fill the memory.
class NearEdges {
public:
    NearEdges(std::uint32_t vertex_count, std::span<const Triangle> triangles, std::uint32_t distance);

    /// [E] lower and higher vertex, rising.
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges() const { return edges_; }

    /// Edges at a vertex.
    std::span<const std::uint32_t> edges_at(std::uint32_t v) const
    {
        return {edge_at_.data() + first_at_[v], first_at_[v + 1ul] - first_at_[v]};
    }

    /// How a sum over the edges near a vertex is put together, for a run of vertices: of vertex `begin + i`, add the sums
    /// over the edges at stars[first_star[i]] .. stars[first_star[i + 1]], and take off the edges inner[first_inner[i]] ..
    /// inner[first_inner[i + 1]], which two of these stars share.
    struct Run {
        std::uint32_t begin = 0;
        std::vector<std::size_t> first_star{0}, first_inner{0};
        std::vector<std::uint32_t> stars, inner;
        std::uint32_t size() const { return static_cast<std::uint32_t>(first_star.size() - 1); }
    };
    /// The run from vertex `begin` to where its lists fill `capacity` entries (it may go beyond by its last list).
    Run run_from(std::uint32_t begin, std::size_t capacity = std::size_t{1} << 24);

private:
    void append_near(std::uint32_t v, Run& run);

    std::uint32_t vertex_count_, distance_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
    std::vector<std::uint32_t> first_at_, edge_at_, other_at_; // edges at each vertex, and where they lead
    std::vector<std::uint32_t> star_of_;                       // the vertex whose lists have it as a star, last of all
};

} // namespace meshreel::metrics
