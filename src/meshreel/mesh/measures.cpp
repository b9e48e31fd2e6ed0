/// Counts fans, loops and components by joining sets.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace meshreel {

namespace {

/// Disjoint sets of 0 .. count-1; the root of a set is its smallest member.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    std::uint32_t root(std::uint32_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

std::array<double, 3> difference(std::span<const float> positions, std::uint32_t a, std::uint32_t b)
{
    std::array<double, 3> d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = double{positions[3ul * b + i]} - positions[3ul * a + i];
    return d;
}

double length(const std::array<double, 3>& d)
{
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

std::uint32_t count_duplicates(std::span<const Triangle> triangles)
{
    std::vector<Triangle> sorted;
    for (Triangle t : triangles) {
        if (is_degenerate(t)) continue;
        std::sort(t.begin(), t.end());
        sorted.push_back(t);
    }
    std::sort(sorted.begin(), sorted.end());
    const auto distinct = std::unique(sorted.begin(), sorted.end());
    return static_cast<std::uint32_t>(sorted.end() - distinct);
}

/// The corner of `c`'s triangle that lies at vertex v.
CornerId corner_at(const CornerTable& table, CornerId c, VertexId v)
{
    return table.vertex(next(c)) == v ? next(c) : table.vertex(previous(c)) == v ? previous(c) : c;
}

/// Corners around a vertex, joined across the edges that have exactly two triangles, however oriented.
Sets fans(const CornerTable& table)
{
    Sets sets(table.corner_count());
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const Edge edge = table.edge(e);
        if (edge.corners.size() != 2) continue;
        for (VertexId v : {edge.low, edge.high})
            sets.join(corner_at(table, edge.corners[0], v).value, corner_at(table, edge.corners[1], v).value);
    }
    return sets;
}

std::uint32_t count_nonmanifold_vertices(const CornerTable& table, std::span<const Triangle> triangles, Sets& fan)
{
    std::vector<std::uint32_t> first_fan(table.vertex_count(), CornerId::none);
    std::vector<std::uint8_t> bad(table.vertex_count(), 0);
    for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
        if (is_degenerate(triangles[c / 3])) continue;
        const std::uint32_t v = table.vertex(CornerId(c)).value;
        if (first_fan[v] == CornerId::none) first_fan[v] = fan.root(c);
        if (first_fan[v] != fan.root(c)) bad[v] = 1;
    }
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const Edge edge = table.edge(e);
        if (edge.kind == EdgeKind::nonmanifold) bad[edge.low.value] = bad[edge.high.value] = 1;
    }
    return static_cast<std::uint32_t>(std::count(bad.begin(), bad.end(), 1));
}

/// Boundary edges are joined where they end in the same fan; what hangs together is a loop.
std::uint32_t count_boundary_loops(const CornerTable& table, Sets& fan)
{
    Sets runs(table.edge_count());
    std::vector<std::uint32_t> edge_at(table.corner_count(), CornerId::none); // by fan
    std::uint32_t loops = 0;
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const Edge edge = table.edge(e);
        if (edge.kind != EdgeKind::boundary) continue;
        ++loops;
        for (VertexId v : {edge.low, edge.high}) {
            const std::uint32_t f = fan.root(corner_at(table, edge.corners[0], v).value);
            if (edge_at[f] == CornerId::none) {
                edge_at[f] = e;
            } else if (runs.root(edge_at[f]) != runs.root(e)) {
                runs.join(edge_at[f], e);
                --loops;
            }
        }
    }
    return loops;
}

/// Components of triangles joined by vertices.
std::uint32_t count_components(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    Sets sets(vertex_count);
    std::vector<std::uint8_t> used(vertex_count, 0);
    for (const Triangle& t : triangles) {
        if (is_degenerate(t)) continue;
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
        used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < vertex_count; ++v) count += used[v] != 0 && sets.root(v) == v;
    return count;
}

std::uint32_t count_isolated(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    std::vector<std::uint8_t> isolated(vertex_count, 1);
    for (const Triangle& t : triangles)
        if (!is_degenerate(t)) isolated[t[0]] = isolated[t[1]] = isolated[t[2]] = 0;
    return static_cast<std::uint32_t>(std::count(isolated.begin(), isolated.end(), 1));
}

} // namespace

std::vector<double> triangle_areas(std::span<const Triangle> triangles, std::span<const float> positions)
{
    std::vector<double> areas(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto a = difference(positions, triangles[t][0], triangles[t][1]);
        const auto b = difference(positions, triangles[t][0], triangles[t][2]);
        areas[t] = 0.5 * length({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
    }
    return areas;
}

double total_area(std::span<const Triangle> triangles, std::span<const float> positions)
{
    double sum = 0;
    for (double area : triangle_areas(triangles, positions)) sum += area;
    return sum;
}

std::vector<double> edge_lengths(const CornerTable& table, std::span<const float> positions)
{
    std::vector<double> lengths(table.edge_count());
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const Edge edge = table.edge(e);
        lengths[e] = length(difference(positions, edge.low.value, edge.high.value));
    }
    return lengths;
}

Topology describe(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    const CornerTable table(vertex_count, triangles);
    Topology topology;
    topology.vertices = vertex_count;
    topology.triangles = static_cast<std::uint32_t>(triangles.size());
    topology.isolated_vertices = count_isolated(vertex_count, triangles);
    topology.degenerate_triangles =
        static_cast<std::uint32_t>(std::count_if(triangles.begin(), triangles.end(), is_degenerate));
    topology.duplicated_triangles = count_duplicates(triangles);
    topology.edges = table.edge_count();
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const EdgeKind kind = table.edge(e).kind;
        topology.boundary_edges += kind == EdgeKind::boundary;
        topology.inconsistent_edges += kind == EdgeKind::inconsistent;
        topology.nonmanifold_edges += kind == EdgeKind::nonmanifold;
    }
    Sets fan = fans(table);
    topology.nonmanifold_vertices = count_nonmanifold_vertices(table, triangles, fan);
    topology.boundary_loops = count_boundary_loops(table, fan);
    topology.components = count_components(vertex_count, triangles);
    topology.euler = std::int64_t{vertex_count} - topology.isolated_vertices - topology.edges + topology.triangles -
                     topology.degenerate_triangles;
    return topology;
}

} // namespace meshreel
