/// The corner table: which corner lies across each edge, for triangle lists of any kind.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/id.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

constexpr CornerId next(CornerId c)
{
    return CornerId(c.value % 3 == 2 ? c.value - 2 : c.value + 1);
}
constexpr CornerId previous(CornerId c)
{
    return CornerId(c.value % 3 == 0 ? c.value + 2 : c.value - 1);
}
constexpr TriangleId triangle_of(CornerId c)
{
    return TriangleId(c.value / 3);
}

/// Whether a triangle names a vertex twice.
constexpr bool is_degenerate(const Triangle& t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// How the triangles at an edge fit together.
enum class EdgeKind : std::uint8_t {
    boundary,     ///< one triangle
    interior,     ///< two triangles that run along it in opposite directions
    inconsistent, ///< two triangles that run along it in the same direction
    nonmanifold   ///< three triangles or more
};

/// An edge and the corners that face it, one in each of its triangles.
struct Edge {
    VertexId low, high;                ///< low < high
    std::span<const CornerId> corners; ///< rising; at least one
    EdgeKind kind = EdgeKind::boundary;
};

/// Adjacency of a triangle list. Corner c = 3 t + i is where triangle t has its i-th vertex; it faces the edge between
/// its other two vertices.
///
///            c                 c faces the edge next(c) - previous(c);
///          /   \               opposite(c) is the corner o of the other triangle
///   next(c) --- previous(c)    that faces the same edge.
///          \   /
///            o
///
/// Nothing is repaired: across a boundary, nonmanifold or inconsistent edge there is no opposite corner. Degenerate
/// triangles (a repeated vertex) keep their corners, but have no edges and no opposites.
class CornerTable {
public:
    /// triangles: [T], vertices 0 .. vertex_count-1; kept by reference for the table's life.
    /// @cost O(V + T log valence) time; 28 bytes a corner at most.
    CornerTable(std::uint32_t vertex_count, std::span<const Triangle> triangles);

    std::uint32_t vertex_count() const { return vertex_count_; }
    std::uint32_t corner_count() const { return static_cast<std::uint32_t>(opposite_.size()); }
    VertexId vertex(CornerId c) const { return VertexId(triangles_[c.value / 3][c.value % 3]); }
    /// The corner across the edge that c faces; none where there is not exactly one that fits.
    CornerId opposite(CornerId c) const { return opposite_[c.value]; }

    std::uint32_t edge_count() const { return static_cast<std::uint32_t>(first_corner_.size()) - 1; }
    /// Edge 0 .. edge_count()-1, in rising order of (low, high).
    Edge edge(std::uint32_t e) const;
    /// The edge that a corner faces; VertexId::none in a degenerate triangle.
    std::uint32_t edge_facing(CornerId c) const { return edge_facing_[c.value]; }

private:
    EdgeKind kind_of(std::uint32_t e) const;

    std::uint32_t vertex_count_;
    std::span<const Triangle> triangles_;
    std::vector<CornerId> opposite_;          // [3T]
    std::vector<std::uint32_t> edge_facing_;  // [3T]
    std::vector<CornerId> edge_corners_;      // [<= 3T] grouped by edge
    std::vector<std::uint32_t> first_corner_; // [E + 1] into edge_corners_
};

} // namespace meshreel
