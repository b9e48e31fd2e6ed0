/// Fans first, then one dummy a boundary loop.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/closed_mesh.h"

namespace meshreel::connectivity {

namespace {

/// Gives every corner of the input's triangles its copy, fan by fan.
void split_fans(const Adjacency& mesh, ClosedMesh& closed)
{
    const auto corners = static_cast<std::uint32_t>(mesh.twin.size());
    for (std::uint32_t seed = 0; seed < corners; ++seed) {
        if (closed.copy_at[seed] != none) continue;
        const auto copy = static_cast<std::uint32_t>(closed.vertex_of.size());
        closed.vertex_of.push_back(mesh.from(seed));
        for (std::uint32_t h = seed; h != none && closed.copy_at[h] == none; h = mesh.twin[previous_half(h)])
            closed.copy_at[h] = copy;
        for (std::uint32_t h = mesh.twin[seed]; h != none; h = mesh.twin[h]) {
            h = next_half(h);
            if (closed.copy_at[h] != none) break;
            closed.copy_at[h] = copy;
        }
    }
}

/// The boundary half-edge that begins where boundary half-edge h ends, in the same fan.
std::uint32_t next_on_boundary(const Adjacency& mesh, std::uint32_t h)
{
    std::uint32_t around = next_half(h);
    while (mesh.twin[around] != none) around = next_half(mesh.twin[around]);
    return around;
}

/// Closes the boundary loop through half-edge `start` with triangles (end of edge, begin of edge, dummy).
void close_loop(const Adjacency& mesh, std::uint32_t start, ClosedMesh& closed)
{
    const auto dummy = static_cast<std::uint32_t>(closed.vertex_of.size());
    closed.vertex_of.push_back(none);
    const auto first = static_cast<std::uint32_t>(closed.twin.size());
    std::uint32_t h = start;
    do {
        const auto mine = static_cast<std::uint32_t>(closed.twin.size());
        closed.twin[h] = mine;
        // Half-edge mine + 1 runs into the dummy beside the edge before, mine + 2 out of it beside the edge after.
        closed.twin.insert(closed.twin.end(), {h, mine - 1, mine + 4});
        closed.copy_at.insert(closed.copy_at.end(), {closed.copy_at[next_half(h)], closed.copy_at[h], dummy});
        h = next_on_boundary(mesh, h);
    } while (h != start);
    const auto end = static_cast<std::uint32_t>(closed.twin.size());
    closed.twin[first + 1] = end - 1;
    closed.twin[end - 1] = first + 1;
}

} // namespace

ClosedMesh close(const Adjacency& mesh)
{
    ClosedMesh closed;
    closed.real_triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    closed.twin = mesh.twin;
    closed.copy_at.assign(mesh.twin.size(), none);
    split_fans(mesh, closed);
    for (std::uint32_t h = 0; h < mesh.twin.size(); ++h)
        if (closed.twin[h] == none) close_loop(mesh, h, closed);
    return closed;
}

} // namespace meshreel::connectivity
