/// What an animation in space-time promises: no holes, the way back, and slices.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/space_time.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

namespace {

using Face = std::array<std::uint32_t, 3>;

template <std::size_t N>
std::array<std::uint32_t, N> in_order(std::array<std::uint32_t, N> corners)
{
    std::sort(corners.begin(), corners.end());
    return corners;
}

template <std::size_t N>
bool names_twice(const std::array<std::uint32_t, N>& sorted)
{
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// How many tetrahedra (those that name a vertex twice left out) have each face.
std::map<Face, int> faces_of(const std::vector<Tetrahedron>& tetrahedra)
{
    std::map<Face, int> faces;
    for (const Tetrahedron& t : tetrahedra) {
        const Tetrahedron s = in_order(t);
        if (names_twice(s)) continue;
        for (std::size_t i = 0; i < 4; ++i) ++faces[{s[i == 0], s[i <= 1 ? 2 : 1], s[i <= 2 ? 3 : 2]}];
    }
    return faces;
}

/// How many triangles there are on each set of vertices (a triangle's three, an edge's two).
std::map<std::set<std::uint32_t>, int> triangles_on(const std::vector<Triangle>& triangles)
{
    std::map<std::set<std::uint32_t>, int> count;
    for (const Triangle& t : triangles) {
        if (names_twice(in_order(t))) continue;
        ++count[{t[0], t[1], t[2]}];
        for (std::size_t i = 0; i < 3; ++i) ++count[{t[i], t[(i + 1) % 3]}];
    }
    return count;
}

/// Two for a face inside, one in the first and the last frame and above a border; as often as triangles lie there.
int expected_count(const Face& face, const Animation& a, const std::map<std::set<std::uint32_t>, int>& triangles)
{
    const std::uint32_t V = a.vertex_count;
    std::set<std::uint32_t> shadow{face[0] % V, face[1] % V, face[2] % V};
    const int there = triangles.at(shadow);
    if (shadow.size() == 2) return there; // above an edge: once for each of its triangles, two where it is no border
    const bool level = face[0] / V == face[2] / V;
    const bool end = level && (face[0] / V == 0 || face[0] / V + 1 == a.frame_count());
    return end ? there : 2 * there;
}

Animation sphere()
{
    return *shapes::generate(*shapes::find("jelly"), {.vertices = 300, .frames = 6});
}

} // namespace

TEST(SpaceTime, HasThreeTetrahedraForEachTriangleAndInterval)
{
    for (const auto& [name, a] : test_shapes::all()) {
        const SpaceTimeMesh mesh = *to_space_time(a);
        EXPECT_EQ(mesh.tetrahedra.size(), 3 * a.triangles.size() * (a.frame_count() - 1)) << name;
        EXPECT_EQ(mesh.vertices.rows, a.vertex_count * a.frame_count()) << name;
    }
}

TEST(SpaceTime, HasNoHoles)
{
    for (const auto& [name, a] : test_shapes::all()) {
        const auto triangles = triangles_on(a.triangles);
        for (const auto& [face, count] : faces_of(to_space_time(a)->tetrahedra))
            ASSERT_EQ(count, expected_count(face, a, triangles))
                << name << ' ' << face[0] << ' ' << face[1] << ' ' << face[2];
    }
}

TEST(SpaceTime, OfAClosedMeshHasItsFirstAndLastFrameAsItsOnlyBorder)
{
    const Animation a = test_shapes::double_torus();
    std::size_t border = 0;
    for (const auto& [face, count] : faces_of(to_space_time(a)->tetrahedra)) {
        border += count == 1;
        ASSERT_LE(count, 2);
    }
    EXPECT_EQ(border, 2 * a.triangles.size());
}

TEST(SpaceTime, TetrahedraFillTheirPrism) // a still triangle of area 1/2, an interval 2 long: a volume of 1
{
    const double points[6][4] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 2}, {1, 0, 0, 2}, {0, 1, 0, 2}};
    double volume = 0.0;
    for (const Tetrahedron& t : swept({2, 0, 1}, 3)) {
        double e[3][3];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t axis = c == 2 ? 3 : c;
                e[i][c] = points[t[i + 1]][axis] - points[t[0]][axis];
            }
        volume += std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                  6;
    }
    EXPECT_DOUBLE_EQ(volume, 1.0);
}

TEST(SpaceTime, GivesTheAnimationBack)
{
    for (const auto& [name, a] : test_shapes::all()) {
        const Result<Animation> back = to_animation(*to_space_time(a));
        ASSERT_TRUE(back.ok()) << name << ": " << back.error().sentence();
        EXPECT_EQ(back->triangles, a.triangles) << name;
        EXPECT_EQ(back->positions, a.positions) << name;
        ASSERT_EQ(back->frame_count(), a.frame_count()) << name;
        for (std::size_t f = 0; f < a.frame_count(); ++f) EXPECT_DOUBLE_EQ(back->times_s[f], a.times_s[f]) << name;
    }
}

TEST(SpaceTime, ThatNoAnimationSweepsIsRefused)
{
    const SpaceTimeMesh good = *to_space_time(test_shapes::torus());
    SpaceTimeMesh other = good;
    std::swap(other.tetrahedra.back()[0], other.tetrahedra.back()[3]);
    EXPECT_EQ(to_animation(other).error().field, "tetrahedra");
    other = good;
    other.tetrahedra.front()[0] = 0xffffffff;
    EXPECT_FALSE(to_animation(other).ok());
    other = good;
    other.vertices(1, 3) += 1;
    EXPECT_EQ(to_animation(other).error().field, "vertices");
    other = good;
    other.tetrahedra.pop_back();
    EXPECT_EQ(to_animation(other).error().field, "tetrahedra");
    other = good;
    other.vertices_a_frame = 7;
    EXPECT_FALSE(to_animation(other).ok());
}

TEST(SpaceTime, MeasuresTimeInBodyDiagonals)
{
    Animation a = test_shapes::torus();
    const SpaceTimeMesh mesh = *to_space_time(a, 0.1);
    EXPECT_DOUBLE_EQ(mesh.vertices(a.vertex_count, 3) - mesh.vertices(0, 3),
                     0.1 * body_diagonal(a) * (a.times_s[1] - a.times_s[0]));
    EXPECT_EQ(units_a_second(std::vector<float>(30, 5.0f), 0.25), 0.25); // no extent
}

TEST(Slice, AtTheTimeOfAFrameIsThatFrame)
{
    for (const auto& [name, a] : test_shapes::all())
        for (std::size_t f = 0; f < a.frame_count(); ++f) {
            const Animation s = *slice(a, a.times_s[f]);
            ASSERT_EQ(s.triangles, a.triangles) << name;
            ASSERT_TRUE(std::equal(s.positions.begin(), s.positions.end(), a.frame(f).begin(), a.frame(f).end()))
                << name;
        }
}

TEST(Slice, BetweenFramesIsClosedWithTheHandlesOfTheMesh)
{
    for (const Animation& a :
         {sphere(), test_shapes::tetrahedron(), test_shapes::torus(), test_shapes::double_torus()}) {
        const Animation s = *slice(a, 0.3 * a.times_s[1] + 0.7 * a.times_s[2]);
        const Topology now = describe(s.vertex_count, s.triangles), was = describe(a.vertex_count, a.triangles);
        EXPECT_TRUE(now.closed_manifold());
        EXPECT_EQ(now.euler, was.euler);
        EXPECT_EQ(now.triangles, 4 * was.triangles);
        EXPECT_EQ(now.vertices, was.vertices + was.edges);
    }
}

TEST(Slice, KeepsBordersComponentsAndBadEdgesAsTheyAre)
{
    for (const auto& [name, a] : test_shapes::all()) {
        const Topology was = describe(a.vertex_count, a.triangles);
        if (a.frame_count() < 2 || was.duplicated_triangles > 0) continue; // a copy has inner edges, too
        const Animation s = *slice(a, (a.times_s[0] + a.times_s[1]) / 2);
        ASSERT_TRUE(validate(s).ok()) << name;
        const Topology now = describe(s.vertex_count, s.triangles);
        EXPECT_EQ(now.euler, was.euler) << name;
        EXPECT_EQ(now.boundary_edges, 2 * was.boundary_edges) << name;
        EXPECT_EQ(now.nonmanifold_edges, 2 * was.nonmanifold_edges) << name;
        EXPECT_EQ(now.components, was.components) << name;
    }
}

TEST(Slice, HasTheVerticesOfTheTetrahedraCutAtThatTime)
{
    const Animation a = sphere();
    const double time = 0.25 * a.times_s[2] + 0.75 * a.times_s[3];
    const Animation s = *slice(a, time);
    std::set<std::array<float, 3>> cut, made;
    const std::uint32_t V = a.vertex_count;
    for (const Tetrahedron& t : interval_tetrahedra(a.triangles, V))
        for (const std::uint32_t low : t)
            for (const std::uint32_t high : t) {
                if (low >= V || high < V) continue;
                const double part = (time - a.times_s[2]) / (a.times_s[3] - a.times_s[2]);
                std::array<float, 3> p;
                for (std::size_t c = 0; c < 3; ++c)
                    p[c] = static_cast<float>((1.0 - part) * a.frame(2)[3ul * low + c] +
                                              part * a.frame(3)[3ul * (high - V) + c]);
                cut.insert(p);
            }
    for (std::size_t i = 0; i < s.positions.size(); i += 3)
        made.insert({s.positions[i], s.positions[i + 1], s.positions[i + 2]});
    EXPECT_EQ(cut, made);
}

TEST(Slice, NearAFrameIsNearThatFrame)
{
    const Animation a = sphere();
    const Animation s = *slice(a, a.times_s[1] + 1e-9);
    for (std::size_t i = 0; i < 3ul * a.vertex_count; ++i) EXPECT_NEAR(s.positions[i], a.frame(1)[i], 1e-6);
    EXPECT_NEAR(total_area(s.triangles, s.positions), total_area(a.triangles, a.frame(1)), 1e-5);
}

TEST(Slice, OutsideTheAnimationIsAnError)
{
    const Animation a = test_shapes::torus();
    EXPECT_EQ(slice(a, a.times_s.front() - 1).error().code, ErrorCode::usage);
    EXPECT_EQ(slice(a, a.times_s.back() + 1).error().code, ErrorCode::usage);
    EXPECT_EQ(slice(a, std::nan("")).error().code, ErrorCode::usage);
}
