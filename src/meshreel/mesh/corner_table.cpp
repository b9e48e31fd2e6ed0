/// Builds the corner table by sorting the sides of all triangles.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/corner_table.h"

#include <algorithm>

namespace meshreel {

namespace {

/// One side of a triangle: the corner that faces it, and its higher vertex. The lower one is the bucket it lies in.
struct Side {
    std::uint32_t high;
    CornerId facing;

    friend bool operator<(const Side& a, const Side& b)
    {
        return a.high != b.high ? a.high < b.high : a.facing < b.facing;
    }
};

struct Ends {
    std::uint32_t from, to; ///< as the triangle runs
    std::uint32_t low() const { return std::min(from, to); }
    std::uint32_t high() const { return std::max(from, to); }
};

Ends ends_facing(std::span<const Triangle> triangles, CornerId c)
{
    const Triangle& t = triangles[c.value / 3];
    return {t[next(c).value % 3], t[previous(c).value % 3]};
}

/// Calls visit(corner) for every corner that faces an edge.
template <class Visit>
void for_each_side(std::span<const Triangle> triangles, Visit visit)
{
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (is_degenerate(triangles[t])) continue;
        for (std::size_t i = 0; i < 3; ++i) visit(CornerId(static_cast<std::uint32_t>(3 * t + i)));
    }
}

/// first[v] .. first[v + 1]: the sides whose lower vertex is v, sorted by higher vertex, then by corner.
std::vector<Side> sorted_sides(std::span<const Triangle> triangles, std::vector<std::uint32_t>& first)
{
    for_each_side(triangles, [&](CornerId c) { ++first[ends_facing(triangles, c).low() + 1]; });
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<Side> sides(first.back());
    std::vector<std::uint32_t> place(first.begin(), first.end() - 1);
    for_each_side(triangles, [&](CornerId c) {
        const Ends ends = ends_facing(triangles, c);
        sides[place[ends.low()]++] = {ends.high(), c};
    });
    for (std::size_t v = 0; v + 1 < first.size(); ++v)
        std::sort(sides.begin() + first[v], sides.begin() + first[v + 1]);
    return sides;
}

} // namespace

CornerTable::CornerTable(std::uint32_t vertex_count, std::span<const Triangle> triangles)
    : vertex_count_(vertex_count), triangles_(triangles), opposite_(triangles.size() * 3),
      edge_facing_(triangles.size() * 3, VertexId::none)
{
    std::vector<std::uint32_t> first(vertex_count + 1ul, 0);
    const std::vector<Side> sides = sorted_sides(triangles, first);
    edge_corners_.reserve(sides.size());
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
            if (i == first[v] || sides[i].high != sides[i - 1].high) first_corner_.push_back(i);
            edge_facing_[sides[i].facing.value] = static_cast<std::uint32_t>(first_corner_.size() - 1);
            edge_corners_.push_back(sides[i].facing);
        }
    first_corner_.push_back(static_cast<std::uint32_t>(sides.size()));
    for (std::uint32_t e = 0; e < edge_count(); ++e) {
        if (kind_of(e) != EdgeKind::interior) continue;
        const CornerId a = edge_corners_[first_corner_[e]], b = edge_corners_[first_corner_[e] + 1];
        opposite_[a.value] = b;
        opposite_[b.value] = a;
    }
}

EdgeKind CornerTable::kind_of(std::uint32_t e) const
{
    const std::uint32_t first = first_corner_[e], count = first_corner_[e + 1] - first;
    if (count == 1) return EdgeKind::boundary;
    if (count > 2) return EdgeKind::nonmanifold;
    const bool same_direction =
        ends_facing(triangles_, edge_corners_[first]).from == ends_facing(triangles_, edge_corners_[first + 1]).from;
    return same_direction ? EdgeKind::inconsistent : EdgeKind::interior;
}

Edge CornerTable::edge(std::uint32_t e) const
{
    const std::span<const CornerId> corners{edge_corners_.data() + first_corner_[e],
                                            first_corner_[e + 1] - first_corner_[e]};
    const Ends ends = ends_facing(triangles_, corners.front());
    return {VertexId(ends.low()), VertexId(ends.high()), corners, kind_of(e)};
}

} // namespace meshreel
