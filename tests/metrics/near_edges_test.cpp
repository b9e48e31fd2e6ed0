/// The edges near a vertex are those of a breadth-first search, for any connectivity.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <set>

#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/near_edges.h"

using namespace meshreel;

namespace {

/// Edges incident with any vertex at most `distance` edges away, found by widening a set.
std::set<std::uint32_t> near_by_definition(const metrics::NearEdges& near, std::uint32_t v, std::uint32_t distance)
{
    std::set<std::uint32_t> vertices{v}, edges;
    for (std::uint32_t step = 0; step <= distance; ++step) {
        const std::set<std::uint32_t> before = vertices;
        for (std::uint32_t e = 0; e < near.edges().size(); ++e) {
            const auto [a, b] = near.edges()[e];
            if (!before.count(a) && !before.count(b)) continue;
            edges.insert(e);
            vertices.insert({a, b});
        }
    }
    return edges;
}

} // namespace

TEST(NearEdges, AreTheEdgesAtVerticesOfTheNeighbourhood)
{
    for (const auto& [name, animation] : test_shapes::all())
        for (std::uint32_t distance : {0u, 1u, 3u}) {
            metrics::NearEdges near(animation.vertex_count, animation.triangles, distance);
            const auto run = near.run_from(0);
            ASSERT_EQ(run.size(), animation.vertex_count);
            for (std::uint32_t v = 0; v < run.size(); v += 5) {
                const std::vector<std::uint32_t> list(run.edges.begin() + run.first[v],
                                                      run.edges.begin() + run.first[v + 1ul]);
                const std::set<std::uint32_t> found(list.begin(), list.end());
                EXPECT_EQ(found.size(), list.size()) << name << ": an edge is listed twice";
                EXPECT_EQ(found, near_by_definition(near, v, distance)) << name << " " << v << " " << distance;
            }
        }
}

TEST(NearEdges, RunsOfAnyCapacityJoinToTheSameLists)
{
    const Animation animation = test_shapes::torus();
    metrics::NearEdges near(animation.vertex_count, animation.triangles, 1);
    const auto whole = near.run_from(0);
    std::vector<std::uint32_t> joined;
    for (auto run = near.run_from(0, 100); run.size() > 0; run = near.run_from(run.begin + run.size(), 100))
        joined.insert(joined.end(), run.edges.begin(), run.edges.end());
    EXPECT_EQ(joined, whole.edges);
}
