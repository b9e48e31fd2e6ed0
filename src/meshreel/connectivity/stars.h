/// The triangles and edges of every vertex of a triangle list.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::connectivity {

/// An edge seen from one of its vertices.
struct Spoke {
    std::uint32_t vertex; ///< the other one
    std::uint32_t count;  ///< triangles that have the edge
};

/// Stars of a mesh. Degenerate triangles have no edges, and what they touch is stuck.
class Stars {
public:
    Stars() = default;
    /// @param vertex_count above every index.  @cost O(W + T log of the largest degree), 64 bytes a triangle.
    Stars(std::uint32_t vertex_count, std::span<const Triangle> triangles);

    /// Indices of the triangles that have v, rising.
    std::span<const std::uint32_t> triangles(std::uint32_t v) const
    {
        return std::span(star_).subspan(star_begin_[v], star_begin_[v + 1] - star_begin_[v]);
    }
    /// The edges of v, by their other vertices.
    std::span<const Spoke> spokes(std::uint32_t v) const
    {
        return std::span(spokes_).subspan(spoke_begin_[v], spoke_begin_[v + 1] - spoke_begin_[v]);
    }
    std::uint32_t degree(std::uint32_t v) const { return spoke_begin_[v + 1] - spoke_begin_[v]; }
    /// Triangles that have the edge a-b; 0 where it is none.
    std::uint32_t triangles_at(std::uint32_t a, std::uint32_t b) const;
    /// Has a degenerate triangle.
    bool stuck(std::uint32_t v) const { return stuck_[v] != 0; }

private:
    void collect_spokes(std::span<const Triangle> triangles);

    std::vector<std::uint32_t> star_begin_, star_;
    std::vector<std::uint32_t> spoke_begin_;
    std::vector<Spoke> spokes_;
    std::vector<std::uint8_t> stuck_;
};

} // namespace meshreel::connectivity
