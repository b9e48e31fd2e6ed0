/// Measures of a mesh: lengths, areas, and what kind of connectivity it has.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/mesh/animation.h"
#include "meshreel/mesh/corner_table.h"

namespace meshreel {

/// Areas of all triangles of a frame, [T], squared model units; 0 for degenerate ones. positions: [V x 3].
std::vector<double> triangle_areas(std::span<const Triangle> triangles, std::span<const float> positions);

/// The sum of triangle_areas, added in the order of the triangles.
double total_area(std::span<const Triangle> triangles, std::span<const float> positions);

/// Lengths of all edges of the table in a frame, [E], model units. positions: [V x 3].
std::vector<double> edge_lengths(const CornerTable& table, std::span<const float> positions);

/// The connectivity of a triangle list, in numbers. Degenerate triangles (a repeated vertex) are counted as such and
/// take part in nothing else.
struct Topology {
    std::uint32_t vertices = 0;             ///< V
    std::uint32_t triangles = 0;            ///< T
    std::uint32_t isolated_vertices = 0;    ///< in no triangle, or in degenerate ones only
    std::uint32_t degenerate_triangles = 0; ///< name a vertex twice
    std::uint32_t duplicated_triangles = 0; ///< have the same three vertices, in any order, as an earlier triangle
    std::uint32_t edges = 0;                ///< pairs of vertices that a triangle joins
    std::uint32_t boundary_edges = 0;       ///< with one triangle
    std::uint32_t inconsistent_edges = 0;   ///< with two triangles that run along it in the same direction
    std::uint32_t nonmanifold_edges = 0;    ///< with three triangles or more
    std::uint32_t nonmanifold_vertices = 0; ///< whose triangles are not one fan: bow ties, ends of non-manifold edges
    std::uint32_t components = 0;           ///< of triangles joined by a vertex; isolated vertices are none
    std::uint32_t boundary_loops = 0;       ///< closed runs of boundary edges; fans part them at bow ties
    std::int64_t euler = 0;                 ///< used vertices - edges + triangles, without isolated and degenerate ones

    /// Every edge has two consistent triangles, and every vertex one fan.
    bool closed_manifold() const
    {
        return boundary_edges == 0 && inconsistent_edges == 0 && nonmanifold_edges == 0 && nonmanifold_vertices == 0;
    }
};

/// Describes any triangle list with vertices 0 .. vertex_count-1. @cost O(V + T log T).
Topology describe(std::uint32_t vertex_count, std::span<const Triangle> triangles);

} // namespace meshreel
