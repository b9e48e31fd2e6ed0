/// Edges are matched in buckets of their smaller vertex; orientation spreads breadth first.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/adjacency.h"

#include <algorithm>
#include <utility>

namespace meshreel::connectivity {

namespace {

struct Side {
    std::uint32_t larger; ///< the edge's larger vertex
    std::uint32_t half;
};

/// All edges of proper triangles, sorted by their smaller vertex (buckets) and larger vertex.
struct EdgeTable {
    std::vector<std::uint32_t> begin; ///< [V + 1]
    std::vector<Side> sides;
};

EdgeTable edges_of(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    EdgeTable table{std::vector<std::uint32_t>(vertex_count + 1ul), {}};
    const auto each_edge = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            if (degenerate(triangles[t])) continue;
            for (std::uint32_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
                visit(std::min(a, b), Side{std::max(a, b), 3 * t + i});
            }
        }
    };
    each_edge([&](std::uint32_t smaller, Side) { ++table.begin[smaller + 1]; });
    for (std::uint32_t v = 0; v < vertex_count; ++v) table.begin[v + 1] += table.begin[v];
    table.sides.resize(table.begin.back());
    std::vector<std::uint32_t> end(table.begin.begin(), table.begin.end() - 1);
    each_edge([&](std::uint32_t smaller, Side side) { table.sides[end[smaller]++] = side; });
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        std::ranges::sort(
            std::span(table.sides).subspan(table.begin[v], table.begin[v + 1] - table.begin[v]),
            [](const Side& a, const Side& b) { return std::pair(a.larger, a.half) < std::pair(b.larger, b.half); });
    return table;
}

/// Twins by edge alone, whatever the directions.
std::vector<std::uint32_t> match(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    std::vector<std::uint32_t> twin(triangles.size() * 3, none);
    const EdgeTable table = edges_of(vertex_count, triangles);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        for (std::uint32_t i = table.begin[v], end = i; i < table.begin[v + 1]; i = end) {
            while (end < table.begin[v + 1] && table.sides[end].larger == table.sides[i].larger) ++end;
            if (end - i != 2) continue;
            twin[table.sides[i].half] = table.sides[i + 1].half;
            twin[table.sides[i + 1].half] = table.sides[i].half;
        }
    }
    return twin;
}

/// Decides which triangles are flipped, by breadth-first search over twins; cuts the edges where neighbours disagree.
std::vector<std::uint8_t> orient(std::span<const Triangle> triangles, std::vector<std::uint32_t>& twin)
{
    std::vector<std::uint8_t> flipped(triangles.size()), known(triangles.size());
    std::vector<std::uint32_t> queue;
    const auto vertex = [&](std::uint32_t h) { return triangles[h / 3][h % 3]; };
    for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
        if (known[seed] != 0) continue;
        known[seed] = 1;
        queue.assign(1, seed);
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const std::uint32_t t = queue[head];
            for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
                if (twin[h] == none) continue;
                const std::uint32_t other = twin[h] / 3;
                const bool same_direction = vertex(h) == vertex(twin[h]);
                const std::uint8_t wanted = flipped[t] ^ static_cast<std::uint8_t>(same_direction);
                if (known[other] == 0) {
                    known[other] = 1;
                    flipped[other] = wanted;
                    queue.push_back(other);
                } else if (flipped[other] != wanted) {
                    twin[std::exchange(twin[h], none)] = none;
                }
            }
        }
    }
    return flipped;
}

} // namespace

Adjacency adjacency(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    Adjacency all{{triangles.begin(), triangles.end()}, {}, match(vertex_count, triangles)};
    all.flipped = orient(triangles, all.twin);
    // In a flipped triangle (0 2 1) the edges 0-1 and 2-0 have changed places.
    const auto moved = [&](std::uint32_t h) {
        return h == none || all.flipped[h / 3] == 0 ? h : h - h % 3 + 2 - h % 3;
    };
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (all.flipped[t] == 0) continue;
        std::swap(all.triangles[t][1], all.triangles[t][2]);
        std::swap(all.twin[3 * t], all.twin[3 * t + 2]);
    }
    for (std::uint32_t& h : all.twin) h = moved(h);
    return all;
}

} // namespace meshreel::connectivity
