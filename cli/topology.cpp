/// Prints what mesh/measures.h counts: every count as JSON, the unusual ones for people.
// SPDX-License-Identifier: MIT
#include "cli/topology.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshreel/mesh/measures.h"

namespace meshreel::cli {

namespace {

Topology topology_of(const Animation& animation)
{
    return describe(animation.vertex_count, animation.triangles);
}

} // namespace

Json topology_json(const Animation& animation)
{
    const Topology t = topology_of(animation);
    return {{"isolated_vertices", t.isolated_vertices},
            {"degenerate_triangles", t.degenerate_triangles},
            {"duplicated_triangles", t.duplicated_triangles},
            {"edges", t.edges},
            {"boundary_edges", t.boundary_edges},
            {"inconsistent_edges", t.inconsistent_edges},
            {"nonmanifold_edges", t.nonmanifold_edges},
            {"nonmanifold_vertices", t.nonmanifold_vertices},
            {"components", t.components},
            {"boundary_loops", t.boundary_loops},
            {"euler", t.euler},
            {"closed_manifold", t.closed_manifold()}};
}

std::string topology_text(const Animation& animation)
{
    const Topology t = topology_of(animation);
    std::string text = fmt::format("  topology    {} edges, {} components, {} boundary loops, Euler number {}{}\n",
                                   human_count(t.edges), t.components, t.boundary_loops, t.euler,
                                   t.closed_manifold() ? ", closed manifold" : "");
    const std::vector<std::pair<std::uint32_t, const char*>> remarks{
        {t.isolated_vertices, "vertices without a triangle"},
        {t.degenerate_triangles, "triangles that name a vertex twice"},
        {t.duplicated_triangles, "triangles that repeat an earlier one"},
        {t.inconsistent_edges, "edges whose triangles are oriented against each other"},
        {t.nonmanifold_edges, "edges with three triangles or more"},
        {t.nonmanifold_vertices, "vertices whose triangles are not one fan"},
    };
    for (const auto& [count, what] : remarks)
        if (count > 0) text += fmt::format("  remark      {} {}\n", human_count(count), what);
    return text;
}

} // namespace meshreel::cli
