/// Decimation: holes, ears, levels, and what both sides may rely on whatever the answers.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "meshreel/connectivity/decimation.h"
#include "meshreel/connectivity/decimation_plan.h"
#include "meshreel/connectivity/trace.h"
#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "tests/connectivity/shapes.h"

namespace meshreel::connectivity {
namespace {

Surface surface_of(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    return trace(vertex_count, triangles).surface;
}

std::vector<List> meshes()
{
    std::vector<List> all = every_list();
    for (std::uint64_t seed = 0; seed < 40; ++seed) all.push_back(soup(seed));
    return all;
}

/// The hole of vertex 0, or none.
std::optional<Hole> hole_of_first(std::uint32_t vertex_count, const std::vector<Triangle>& triangles)
{
    Hole hole;
    const Stars stars(vertex_count, triangles);
    if (!find_hole({triangles, stars}, 0, hole)) return std::nullopt;
    return hole;
}

/// Whoever is asked goes, or does not, by the toss of a coin.
Goes coin(Random& random, std::uint64_t sides)
{
    return [&random, sides](std::uint32_t, std::uint32_t, std::uint32_t) { return random.below(sides) == 0; };
}

Goes by(const Plan& plan)
{
    return [&plan](std::uint32_t level, std::uint32_t v, std::uint32_t) { return plan.level[v] == level; };
}

/// A vertex is the worse the higher its number.
double by_number(const Mesh&, std::uint32_t v, const Hole&)
{
    return v;
}

TEST(hole, is_cut_at_the_tip_of_highest_degree_between_the_lowest)
{
    // Degrees without the hub: 1: 2, 2: 2, 3: 3, 4: 3, 5: 2, and 6 beside the edge 3-4.
    const auto hole = hole_of_first(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}, {4, 3, 6}});
    ASSERT_TRUE(hole);
    EXPECT_EQ(hole->ring, (std::vector<std::uint32_t>{1, 2, 3, 4, 5}));
    // Tip 1: 2 - 2 - 2; tip 2: 2 - 2 - 3; 3: 3 - 2 - 3; 4: 3 - 3 - 2; 5: 2 - 3 - 2. The first of 1, 3, 4 is cut, then
    // 3 of 2: 3, 3: 3, 4: 3, 5: 3, where all are equal: 2.
    EXPECT_EQ(hole->triangles, (std::vector<Triangle>{{5, 1, 2}, {5, 2, 3}, {3, 4, 5}}));
    EXPECT_EQ(hole->claims, (std::vector<Edge>{{2, 5}, {3, 5}}));
}

TEST(hole, at_a_boundary_is_closed_between_the_ends_of_its_path)
{
    const auto hole = hole_of_first(4, {{0, 1, 2}, {0, 2, 3}});
    ASSERT_TRUE(hole);
    EXPECT_FALSE(hole->closed);
    EXPECT_EQ(hole->triangles, (std::vector<Triangle>{{1, 2, 3}}));
    EXPECT_EQ(hole->claims, (std::vector<Edge>{{1, 3}}));
}

TEST(hole, of_a_single_triangle_needs_another_behind_its_edge)
{
    EXPECT_FALSE(hole_of_first(3, {{0, 1, 2}}));
    const auto hole = hole_of_first(4, {{0, 1, 2}, {2, 1, 3}});
    ASSERT_TRUE(hole);
    EXPECT_TRUE(hole->triangles.empty());
}

TEST(hole, is_refused_where_its_edges_are_there_already)
{
    const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    EXPECT_FALSE(hole_of_first(4, tetrahedron)) << "its triangle is there";
    const std::vector<Triangle> octahedron = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1},
                                              {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
    EXPECT_TRUE(hole_of_first(6, octahedron));
    std::vector<Triangle> crossed = octahedron;
    crossed.insert(crossed.end(), {{1, 3, 6}, {2, 4, 7}});
    EXPECT_FALSE(hole_of_first(8, crossed)) << "both diagonals are edges";
}

TEST(hole, is_none_at_bow_ties_and_reversed_or_doubled_triangles)
{
    EXPECT_FALSE(hole_of_first(5, {{0, 1, 2}, {0, 3, 4}, {2, 1, 3}}));
    EXPECT_FALSE(hole_of_first(4, {{0, 1, 2}, {0, 3, 2}}));
    EXPECT_FALSE(hole_of_first(4, {{0, 1, 2}, {0, 1, 2}, {2, 1, 3}}));
    EXPECT_FALSE(hole_of_first(4, {{0, 0, 2}, {0, 1, 2}, {2, 1, 3}}));
}

TEST(decimation, keeps_manifoldness_and_euler_number_whatever_the_answers)
{
    Random random(7);
    for (const List& list : meshes())
        for (std::uint64_t sides : {1, 2, 5}) {
            const Decimation all = decimate(surface_of(list.vertex_count, list.triangles), 6, coin(random, sides));
            const meshreel::Topology before = describe(list.vertex_count, list.triangles);
            const meshreel::Topology after = describe(all.coarse_count(), all.coarsest);
            EXPECT_EQ(after.euler, before.euler) << list.name;
            EXPECT_EQ(after.isolated_vertices, before.isolated_vertices) << list.name;
            EXPECT_EQ(after.components, before.components) << list.name;
            EXPECT_EQ(after.boundary_loops, before.boundary_loops) << list.name;
            EXPECT_LE(after.nonmanifold_edges, before.nonmanifold_edges) << list.name;
            EXPECT_LE(after.nonmanifold_vertices, before.nonmanifold_vertices) << list.name;
            EXPECT_LE(after.duplicated_triangles, before.duplicated_triangles) << list.name;
        }
}

TEST(decimation, numbers_every_vertex_once_and_rings_hold_coarser_rows_only)
{
    Random random(8);
    for (const List& list : meshes()) {
        const Decimation all = decimate(surface_of(list.vertex_count, list.triangles), 5, coin(random, 2));
        std::vector<std::uint32_t> sorted = all.vertex_of;
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t v = 0; v < list.vertex_count; ++v) ASSERT_EQ(sorted[v], v);
        ASSERT_EQ(all.row_counts.back(), list.vertex_count);
        for (std::size_t level = 0; level + 1 < all.row_counts.size(); ++level)
            for (std::uint32_t row = all.row_counts[level]; row < all.row_counts[level + 1]; ++row)
                for (std::uint32_t neighbour : all.ring(row))
                    EXPECT_LT(neighbour, all.row_counts[level]) << "neighbours of one that goes are locked";
    }
}

TEST(decimation, is_the_same_for_whoever_has_the_answers)
{
    for (const List& list : meshes()) {
        const Surface surface = surface_of(list.vertex_count, list.triangles);
        const Plan plan = plan_decimation(surface, {}, by_number);
        std::vector<bool> answers;
        const Decimation sent =
            decimate(surface, plan.levels, [&](std::uint32_t level, std::uint32_t v, std::uint32_t) {
                answers.push_back(plan.level[v] == level);
                return answers.back();
            });
        std::size_t next = 0;
        const auto told = [&](std::uint32_t, std::uint32_t, std::uint32_t) -> bool { return answers[next++]; };
        const Decimation received = decimate(surface, plan.levels, told);
        EXPECT_EQ(next, answers.size());
        EXPECT_EQ(sent.vertex_of, received.vertex_of);
        EXPECT_EQ(sent.rings, received.rings);
        EXPECT_EQ(sent.coarsest, received.coarsest);
        for (std::uint32_t row = 0; row < list.vertex_count; ++row)
            EXPECT_EQ(row < sent.coarse_count(), plan.level[sent.vertex_of[row]] == 0) << "everyone planned goes";
    }
}

TEST(decimation_plan, leaves_less_than_a_fifth_of_a_good_mesh)
{
    const Animation torus = *shapes::generate(*shapes::find("wave"), {.vertices = 900, .frames = 1});
    const Surface surface = surface_of(torus.vertex_count, torus.triangles);
    const Decimation all = decimate(surface, 31, by(plan_decimation(surface, {}, by_number)));
    EXPECT_LT(all.coarse_count(), 180u);
    EXPECT_GT(all.coarse_count(), 90u) << "the last level stops there";
}

TEST(decimation_plan, considers_only_the_better_part_of_the_queue)
{
    const Animation cloth = *shapes::generate(*shapes::find("wave"), {.vertices = 400, .frames = 1});
    const Surface surface = surface_of(cloth.vertex_count, cloth.triangles);
    Hole hole;
    std::vector<std::uint32_t> queue;
    for (std::uint32_t v = 0; v < 400; ++v)
        if (Decimator(surface).find_hole(v, hole)) queue.push_back(v);
    const Plan plan = plan_decimation(surface, {}, by_number);
    for (std::size_t i = 0; i < queue.size(); ++i)
        EXPECT_TRUE(plan.level[queue[i]] != 1 ||
                    static_cast<double>(i) < std::ceil(0.8 * static_cast<double>(queue.size())))
            << i;
}

TEST(decimation_plan, takes_the_best_predicted_first_and_locks_its_neighbours)
{
    const Animation cloth = *shapes::generate(*shapes::find("wave"), {.vertices = 400, .frames = 1});
    const Surface surface = surface_of(cloth.vertex_count, cloth.triangles);
    const std::uint32_t best = 200;
    const auto cost = [&](const Mesh&, std::uint32_t v, const Hole&) { return v == best ? 0.0 : 1.0 + v; };
    const Plan plan = plan_decimation(surface, {}, cost);
    EXPECT_EQ(plan.level[best], 1);
    const Stars stars(400, surface.triangles);
    for (const Spoke& spoke : stars.spokes(best)) EXPECT_NE(plan.level[spoke.vertex], 1);
}

TEST(decimation_plan, keeps_whose_removal_is_too_dear)
{
    const Animation cloth = *shapes::generate(*shapes::find("wave"), {.vertices = 400, .frames = 1});
    const Plan plan = plan_decimation(surface_of(400, cloth.triangles), {}, by_number, {.dearest = 99.0});
    for (std::uint32_t v = 100; v < 400; ++v) EXPECT_EQ(plan.level[v], 0);
    EXPECT_GT(plan.levels, 1);
}

TEST(decimation_plan, remembers_no_cost_that_has_changed)
{
    // The fewest edges round the ring, which change wherever a neighbour's triangles do.
    const RemovalCost cost = [](const Mesh& mesh, std::uint32_t v, const Hole& hole) {
        double sum = 1e-4 * v;
        for (const std::uint32_t neighbour : hole.ring) sum += mesh.stars.degree(neighbour);
        return sum;
    };
    for (const List& list : meshes()) {
        const Surface surface = surface_of(list.vertex_count, list.triangles);
        std::map<std::uint32_t, double> paid;
        const auto noting = [&](const Mesh& mesh, std::uint32_t v, const Hole& hole) {
            return paid[v] = cost(mesh, v, hole);
        };
        const Plan plan = plan_decimation(surface, {}, noting, {.coarse = 0.0});
        Decimator mesh(surface);
        Hole hole;
        for (int level = 1; level <= plan.levels; ++level) {
            for (std::uint32_t v = 0; v < list.vertex_count; ++v) {
                if (plan.level[v] != level) continue;
                ASSERT_TRUE(mesh.find_hole(v, hole));
                EXPECT_EQ(paid[v], cost(mesh.mesh(), v, hole)) << list.name; // the last asked for: of when it went
                mesh.remove(v, hole);
            }
            mesh.next_level();
        }
    }
}

TEST(decimation_plan, flips_no_normal_and_makes_no_sharp_triangle_in_the_first_frame)
{
    // A flat grid whose vertices are shaken: every triangle must go on facing up.
    Animation grid = *shapes::generate(*shapes::find("wave"), {.vertices = 900, .frames = 1});
    Random random(3);
    const Trace traced = trace(grid.vertex_count, grid.triangles);
    std::vector<float> flat;
    for (std::uint32_t v : traced.vertex_of)
        for (std::size_t i : {0, 1, 2})
            flat.push_back(i == 2 ? 0.0f : grid.positions[3 * v + i] + 0.004f * static_cast<float>(random.uniform()));
    const auto upwards = [&](const Triangle& t) {
        const auto x = [&](std::size_t i) { return flat[3 * t[i]] - flat[3 * t[0]]; };
        const auto y = [&](std::size_t i) { return flat[3 * t[i] + 1] - flat[3 * t[0] + 1]; };
        return x(1) * y(2) - x(2) * y(1);
    };
    const float up = upwards(traced.surface.triangles.front());
    const Plan plan = plan_decimation(traced.surface, flat, by_number);
    const Decimation all = decimate(traced.surface, plan.levels, by(plan));
    EXPECT_LT(all.coarse_count(), 450u);
    for (Triangle t : all.coarsest) {
        for (std::uint32_t& v : t) v = all.vertex_of[v];
        EXPECT_GT(upwards(t) * up, 0.0f);
    }
}

} // namespace
} // namespace meshreel::connectivity
