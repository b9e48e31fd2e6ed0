/// Dijkstra's algorithm from all kept vertices at once, then the triangles where three cells meet.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/coarse_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "meshreel/mesh/corner_table.h"

namespace meshreel {

namespace {

constexpr std::uint32_t no_cell = 0xffffffff;

/// The other corners of the triangles at each vertex, one list after the other.
struct EdgeEnds {
    EdgeEnds(std::size_t vertex_count, std::span<const Triangle> triangles) : first(vertex_count + 1, 0)
    {
        for (const Triangle& t : triangles)
            for (const std::uint32_t v : t) first[v + 1ul] += 2;
        for (std::size_t v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
        others.resize(first.back());
        std::vector<std::size_t> next(first.begin(), first.end() - 1);
        for (const Triangle& t : triangles)
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 1; j < 3; ++j) others[next[t[i]]++] = t[(i + j) % 3];
    }

    std::span<const std::uint32_t> of(std::uint32_t v) const
    {
        return std::span(others).subspan(first[v], first[v + 1ul] - first[v]);
    }

    std::vector<std::size_t> first;
    std::vector<std::uint32_t> others;
};

double distance_of(MatrixView<const double> X, std::uint32_t a, std::uint32_t b)
{
    const double x = X(a, 0) - X(b, 0), y = X(a, 1) - X(b, 1), z = X(a, 2) - X(b, 2);
    return std::sqrt(x * x + y * y + z * z);
}

/// How far a vertex is from a cell's kept vertex; the nearer is the lesser, of equally near ones the earlier.
struct Claim {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t cell = no_cell, vertex = 0;
    friend bool operator<(const Claim& a, const Claim& b)
    {
        return std::tie(a.distance, a.cell, a.vertex) < std::tie(b.distance, b.cell, b.vertex);
    }
    friend bool operator>(const Claim& a, const Claim& b) { return b < a; }
};

/// The cell that each vertex is in, by place in `kept`; no_cell where none can be reached.
std::vector<std::uint32_t> cells_of(const EdgeEnds& edges, MatrixView<const double> X,
                                    std::span<const std::uint32_t> kept)
{
    std::vector<Claim> best(X.rows);
    std::priority_queue<Claim, std::vector<Claim>, std::greater<>> waiting;
    const auto offer = [&](const Claim& claim) {
        if (std::tie(claim.distance, claim.cell) >= std::tie(best[claim.vertex].distance, best[claim.vertex].cell))
            return;
        best[claim.vertex] = claim;
        waiting.push(claim);
    };
    std::vector<bool> is_kept(X.rows);
    for (std::uint32_t i = 0; i < kept.size(); ++i) {
        offer({0.0, i, kept[i]});
        is_kept[kept[i]] = true;
    }
    while (!waiting.empty()) {
        const Claim claim = waiting.top();
        waiting.pop();
        if (best[claim.vertex] < claim) continue; // a better one came later
        for (const std::uint32_t u : edges.of(claim.vertex))
            if (!is_kept[u]) offer({claim.distance + distance_of(X, claim.vertex, u), claim.cell, u});
    }
    std::vector<std::uint32_t> cells;
    for (const Claim& claim : best) cells.push_back(claim.cell);
    return cells;
}

/// The same triangle, its lowest corner first.
Triangle turned(Triangle t)
{
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

} // namespace

CoarseSurface coarse_surface(std::span<const Triangle> triangles, MatrixView<const double> X,
                             std::span<const std::uint32_t> kept)
{
    const std::vector<std::uint32_t> cells = cells_of(EdgeEnds(X.rows, triangles), X, kept);
    struct Found {
        Triangle turned;
        std::uint32_t from;
    };
    std::vector<Found> found;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const Triangle corners{cells[triangles[t][0]], cells[triangles[t][1]], cells[triangles[t][2]]};
        if (!is_degenerate(corners) && corners[0] != no_cell) found.push_back({turned(corners), t});
    }
    std::ranges::sort(
        found, [](const Found& a, const Found& b) { return std::tie(a.turned, a.from) < std::tie(b.turned, b.from); });
    const auto same = [](const Found& a, const Found& b) { return a.turned == b.turned; };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    std::ranges::sort(found, {}, &Found::from);
    CoarseSurface coarse;
    for (const Found& one : found) {
        const Triangle& t = triangles[one.from];
        coarse.triangles.push_back({cells[t[0]], cells[t[1]], cells[t[2]]});
        coarse.triangle_of.push_back(one.from);
    }
    return coarse;
}

} // namespace meshreel
