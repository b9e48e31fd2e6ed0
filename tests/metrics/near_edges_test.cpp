/// The edges near a vertex are those of a breadth-first search, for any connectivity.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <map>
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

TEST(NearEdges, AreTheEdgesOfTheStarsWithThoseThatTwoShareOnce)
{
    for (const auto& [name, animation] : test_shapes::all())
        for (std::uint32_t distance : {0u, 1u, 3u}) {
            metrics::NearEdges near(animation.vertex_count, animation.triangles, distance);
            const auto run = near.run_from(0);
            ASSERT_EQ(run.size(), animation.vertex_count);
            for (std::uint32_t v = 0; v < run.size(); v += 5) {
                std::map<std::uint32_t, int> count, once;
                for (std::size_t s = run.first_star[v]; s < run.first_star[v + 1ul]; ++s)
                    for (const std::uint32_t e : near.edges_at(run.stars[s])) ++count[e];
                for (std::size_t i = run.first_inner[v]; i < run.first_inner[v + 1ul]; ++i) --count[run.inner[i]];
                for (const std::uint32_t e : near_by_definition(near, v, distance)) once[e] = 1;
                EXPECT_EQ(count, once) << name << " " << v << " " << distance;
            }
        }
}

TEST(NearEdges, RunsOfAnyCapacityJoinToTheSameLists)
{
    const Animation animation = test_shapes::torus();
    metrics::NearEdges near(animation.vertex_count, animation.triangles, 1);
    const auto whole = near.run_from(0);
    std::vector<std::uint32_t> stars, inner;
    for (auto run = near.run_from(0, 100); run.size() > 0; run = near.run_from(run.begin + run.size(), 100)) {
        stars.insert(stars.end(), run.stars.begin(), run.stars.end());
        inner.insert(inner.end(), run.inner.begin(), run.inner.end());
    }
    EXPECT_EQ(stars, whole.stars);
    EXPECT_EQ(inner, whole.inner);
}
