/// The connectivity of every awkward shape, in numbers.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

namespace {

Topology topology_of(const Animation& animation)
{
    return describe(animation.vertex_count, animation.triangles);
}

} // namespace

TEST(Topology, EulerNumberIsTwoMinusTwiceTheHandlesOfAClosedSurface)
{
    EXPECT_EQ(topology_of(test_shapes::tetrahedron()).euler, 2);
    EXPECT_EQ(topology_of(test_shapes::torus()).euler, 0);
    EXPECT_EQ(topology_of(test_shapes::double_torus()).euler, -2);
    for (const Animation& closed : {test_shapes::tetrahedron(), test_shapes::torus(), test_shapes::double_torus()}) {
        EXPECT_TRUE(topology_of(closed).closed_manifold());
        EXPECT_EQ(topology_of(closed).components, 1u);
        EXPECT_EQ(topology_of(closed).isolated_vertices, 0u);
    }
}

TEST(Topology, HolesAreCountedAsLoopsOfTheBoundary)
{
    const Topology cube = topology_of(test_shapes::cube_with_hole());
    EXPECT_EQ(cube.boundary_loops, 1u);
    EXPECT_EQ(cube.boundary_edges, 4u);
    EXPECT_EQ(cube.euler, 1);
    const Topology pipe = topology_of(test_shapes::split_seam());
    EXPECT_EQ(pipe.boundary_loops, 1u) << "the seam opens the pipe into a sheet";
}

TEST(Topology, AMoebiusStripHasOneBoundaryAndASeamThatDisagrees)
{
    const Topology strip = topology_of(test_shapes::moebius_strip());
    EXPECT_EQ(strip.euler, 0);
    EXPECT_EQ(strip.boundary_loops, 1u);
    EXPECT_EQ(strip.inconsistent_edges, 2u);
    EXPECT_EQ(strip.nonmanifold_vertices, 0u);
}

TEST(Topology, ComponentsAndIsolatedVerticesAreCountedApart)
{
    const Topology two = topology_of(test_shapes::two_components());
    EXPECT_EQ(two.components, 2u);
    EXPECT_EQ(two.isolated_vertices, 3u);
    EXPECT_EQ(two.boundary_loops, 2u);
    EXPECT_EQ(two.euler, 2);
}

TEST(Topology, ABowTieIsOneNonmanifoldVertexBetweenTwoLoops)
{
    const Topology tie = topology_of(test_shapes::bow_tie());
    EXPECT_EQ(tie.nonmanifold_vertices, 1u);
    EXPECT_EQ(tie.boundary_loops, 2u);
    EXPECT_EQ(tie.components, 1u);
    EXPECT_FALSE(tie.closed_manifold());
}

TEST(Topology, ThreeTrianglesOnAnEdgeAreNonmanifold)
{
    const Topology fin = topology_of(test_shapes::three_on_an_edge());
    EXPECT_EQ(fin.nonmanifold_edges, 1u);
    EXPECT_EQ(fin.nonmanifold_vertices, 2u);
}

TEST(Topology, DuplicatesCountWhateverTheirRotationAndOrientation)
{
    EXPECT_EQ(topology_of(test_shapes::duplicated_triangles()).duplicated_triangles, 4u);
    EXPECT_EQ(topology_of(test_shapes::torus()).duplicated_triangles, 0u);
}

TEST(Topology, DegenerateTrianglesAreCountedAndChangeNothingElse)
{
    const Topology bad = topology_of(test_shapes::degenerate_triangles());
    EXPECT_EQ(bad.degenerate_triangles, 4u);
    EXPECT_EQ(bad.euler, 1);
    EXPECT_EQ(bad.boundary_loops, 1u);
    EXPECT_EQ(bad.boundary_edges, 14u);
}

TEST(Topology, PointsAloneAreAllIsolated)
{
    const Topology points = topology_of(test_shapes::points_only());
    EXPECT_EQ(points.isolated_vertices, 8u);
    EXPECT_EQ(points.components + points.edges + points.boundary_loops, 0u);
    EXPECT_EQ(points.euler, 0);
}

TEST(CornerTable, OppositesAreMutualAndFaceTheSameEdgeInTheOtherDirection)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const CornerTable table(animation.vertex_count, animation.triangles);
        for (std::uint32_t i = 0; i < table.corner_count(); ++i) {
            const CornerId c(i), o = table.opposite(c);
            if (!o.valid()) continue;
            EXPECT_EQ(table.opposite(o), c) << name;
            EXPECT_EQ(table.vertex(next(c)), table.vertex(previous(o))) << name;
            EXPECT_EQ(table.vertex(previous(c)), table.vertex(next(o))) << name;
        }
    }
}

TEST(CornerTable, EdgesAreThePairsOfVerticesThatTrianglesJoin)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> wanted;
        for (const Triangle& t : animation.triangles)
            for (std::size_t i = 0; i < 3 && !is_degenerate(t); ++i) ++wanted[std::minmax({t[i], t[(i + 1) % 3]})];
        const CornerTable table(animation.vertex_count, animation.triangles);
        ASSERT_EQ(table.edge_count(), wanted.size()) << name;
        std::uint32_t e = 0;
        for (const auto& [ends, count] : wanted) { // both in rising order
            EXPECT_EQ(table.edge(e).low.value, ends.first) << name;
            EXPECT_EQ(table.edge(e).high.value, ends.second) << name;
            EXPECT_EQ(table.edge(e).corners.size(), count) << name;
            for (CornerId c : table.edge(e).corners) EXPECT_EQ(table.edge_facing(c), e) << name;
            ++e;
        }
    }
}

TEST(CornerTable, OnlyInteriorEdgesHaveOpposites)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const CornerTable table(animation.vertex_count, animation.triangles);
        for (std::uint32_t e = 0; e < table.edge_count(); ++e)
            for (CornerId c : table.edge(e).corners)
                EXPECT_EQ(table.opposite(c).valid(), table.edge(e).kind == EdgeKind::interior) << name;
        for (std::uint32_t t = 0; t < animation.triangles.size(); ++t)
            EXPECT_FALSE(is_degenerate(animation.triangles[t]) && table.opposite(CornerId(3 * t)).valid()) << name;
    }
}

TEST(Measures, AreasAndLengthsOfTheUnitCube)
{
    Animation cube = test_shapes::cube_with_hole();
    cube.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    EXPECT_DOUBLE_EQ(total_area(cube.triangles, cube.frame(0)), 5.0);
    EXPECT_DOUBLE_EQ(triangle_areas(cube.triangles, cube.frame(0))[3], 0.5);
    const CornerTable table(cube.vertex_count, cube.triangles);
    double longest = 0;
    for (double length : edge_lengths(table, cube.frame(0))) longest = std::max(longest, length);
    EXPECT_DOUBLE_EQ(longest, std::sqrt(2.0));
}

TEST(TestShapes, AreValidAndNamedOnce)
{
    std::set<std::string> names;
    for (const auto& [name, animation] : test_shapes::all()) {
        EXPECT_TRUE(validate(animation).ok()) << name;
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_LE(animation.vertex_count, 1000u);
        EXPECT_LE(animation.frame_count(), 12u);
    }
}
