/// Edgebreaker by itself: the string, its size, handles, holes, and strings that describe no mesh.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshreel/connectivity/shell.h"
#include "meshreel/connectivity/trace.h"
#include "tests/connectivity/shapes.h"

namespace meshreel::connectivity {
namespace {

ClersString string_of(const List& list)
{
    return conquer(close(adjacency(list.vertex_count, list.triangles)))->string;
}

TEST(edgebreaker, writes_at_most_two_bits_a_triangle_on_simple_meshes)
{
    // An octahedron refined by splitting every triangle in three, four times: closed, one component, no handle.
    std::vector<Triangle> t = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
    std::uint32_t vertices = 6;
    for (int round = 0; round < 4; ++round) {
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : t) {
            finer.insert(finer.end(), {{a, b, vertices}, {b, c, vertices}, {c, a, vertices}});
            ++vertices;
        }
        t = finer;
    }
    EXPECT_LE(string_of({"", vertices, t}).raw_bits(), 2 * t.size());
}

TEST(edgebreaker, spells_a_tetrahedron_as_one_new_vertex_one_turn_and_an_end)
{
    const std::vector<Triangle> t = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    EXPECT_EQ(string_of({"", 4, t}).symbols, (std::vector{Clers::C, Clers::R, Clers::E}));
}

TEST(edgebreaker, merges_two_borders_once_a_handle)
{
    const Animation torus = test_shapes::torus(), two = test_shapes::double_torus();
    EXPECT_EQ(string_of({"", torus.vertex_count, torus.triangles}).merges.size(), 1u);
    EXPECT_EQ(string_of({"", two.vertex_count, two.triangles}).merges.size(), 2u);
}

TEST(edgebreaker, closes_each_hole_with_one_dummy)
{
    const Animation cube = test_shapes::cube_with_hole();
    const ClosedMesh closed = close(adjacency(cube.vertex_count, cube.triangles));
    EXPECT_EQ(std::count(closed.vertex_of.begin(), closed.vertex_of.end(), none), 1);
    EXPECT_EQ(closed.triangle_count(), closed.real_triangles + 4);
}

TEST(edgebreaker, refuses_strings_that_describe_no_mesh)
{
    using enum Clers;
    const auto refused = [](std::vector<Clers> symbols, std::uint32_t triangles, std::vector<Merge> merges = {}) {
        return !rebuild({triangles, std::move(symbols), std::move(merges)});
    };
    EXPECT_TRUE(refused({C, R}, 3));                 // never ends
    EXPECT_TRUE(refused({R, E}, 3));                 // closes a border that is too short
    EXPECT_TRUE(refused({C, E}, 3));                 // ends a border of four edges
    EXPECT_TRUE(refused({S, E, E}, 4));              // splits a border of three
    EXPECT_TRUE(refused({E}, 5));                    // counts disagree
    EXPECT_TRUE(refused({S, E}, 3, {{0, 0, 0, 3}})); // merges with a border that is not there
    EXPECT_TRUE(refused({E}, 2, {{7, 0, 0, 3}}));    // merges beyond the string
    EXPECT_FALSE(refused({C, R, E}, 4));
}

TEST(edgebreaker, stops_a_string_that_would_take_too_many_steps)
{
    // A long border, then merge after split after merge along all of it.
    std::vector<Clers> symbols(2000, Clers::C);
    Random random(3);
    for (int i = 0; i < 4000; ++i) symbols.push_back(random.below(2) == 0 ? Clers::S : Clers::E);
    EXPECT_FALSE(rebuild({static_cast<std::uint32_t>(symbols.size() + 1), symbols, {}}));
}

TEST(trace, meets_a_closed_surface_with_a_full_gate_at_every_vertex_after_the_first_triangle)
{
    const List list = grid(12, true);
    const Trace traced = trace(list.vertex_count, list.triangles);
    for (std::uint32_t v = 3; v < traced.surface.vertex_count; ++v)
        EXPECT_TRUE(traced.surface.gates[v].opposite.valid());
}

TEST(trace, gates_are_edges_of_triangles_of_the_surface)
{
    const List list = grid(7);
    const Surface surface = trace(list.vertex_count, list.triangles).surface;
    for (std::uint32_t tip = 3; tip < surface.vertex_count; ++tip) {
        Triangle wanted = {surface.gates[tip].left.value, surface.gates[tip].right.value, tip};
        std::sort(wanted.begin(), wanted.end());
        const auto is_it = [&](Triangle t) {
            std::sort(t.begin(), t.end());
            return t == wanted;
        };
        EXPECT_TRUE(std::any_of(surface.triangles.begin(), surface.triangles.end(), is_it)) << tip;
    }
}

TEST(trace, puts_isolated_vertices_last_with_empty_gates)
{
    const std::vector<Triangle> one = {{4, 1, 2}};
    const Trace traced = trace(6, one);
    EXPECT_EQ(traced.vertex_of, (std::vector<std::uint32_t>{4, 1, 2, 0, 3, 5}));
    EXPECT_FALSE(traced.surface.gates[3].left.valid());
    EXPECT_EQ(traced.surface.gates[2].left.value, 0u);
    EXPECT_EQ(traced.surface.gates[2].right.value, 1u);
}

} // namespace
} // namespace meshreel::connectivity
