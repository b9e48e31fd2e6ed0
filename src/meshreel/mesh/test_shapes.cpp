/// Builds the awkward animations from lattices and by hand.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/test_shapes.h"

#include <array>
#include <cmath>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"

namespace meshreel::test_shapes {

namespace {

using Points = std::vector<std::array<double, 3>>;

constexpr double turn = 2.0 * 3.14159265358979323846;
constexpr std::size_t usual_frames = 12;

/// Lets the points sway, each a little differently, over F frames.
Animation swaying(const Points& points, std::vector<Triangle> triangles, std::size_t frames = usual_frames)
{
    Animation animation;
    animation.vertex_count = static_cast<std::uint32_t>(points.size());
    animation.triangles = std::move(triangles);
    animation.times_s = uniform_times(frames, 24.0);
    animation.meta.fps = 24.0;
    for (double t : animation.times_s)
        for (const auto& [x, y, z] : points) {
            const double phase = 3.0 * t + x;
            for (double value : {x + 0.1 * exact::sin(phase + y), y * (1.0 + 0.1 * exact::cos(phase)),
                                 z + 0.2 * exact::sin(phase - z)})
                animation.positions.push_back(static_cast<float>(value));
        }
    return animation;
}

/// A lattice of columns x rows cells whose borders may be glued; index(i, j) with i <= columns and j <= rows.
struct Lattice {
    std::uint32_t columns, rows;
    bool closed_i = false, closed_j = false;

    std::uint32_t width() const { return columns + (closed_i ? 0 : 1); }
    std::uint32_t height() const { return rows + (closed_j ? 0 : 1); }
    std::uint32_t index(std::uint32_t i, std::uint32_t j) const { return j % height() * width() + i % width(); }

    std::vector<Triangle> triangles() const
    {
        std::vector<Triangle> all;
        for (std::uint32_t j = 0; j < rows; ++j)
            for (std::uint32_t i = 0; i < columns; ++i) {
                all.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
                all.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
            }
        return all;
    }
    /// place(u, v) at every lattice point, u and v in [0, 1].
    template <class Place>
    Points points(const Place& place) const
    {
        Points all;
        for (std::uint32_t j = 0; j < height(); ++j)
            for (std::uint32_t i = 0; i < width(); ++i) all.push_back(place(double(i) / columns, double(j) / rows));
        return all;
    }
};

std::array<double, 3> flat(double u, double v)
{
    return {4.0 * u, 3.0 * v, 0.5 * u * v};
}
std::array<double, 3> ring(double u, double v)
{
    const double radius = 2.0 + 0.7 * exact::cos(turn * v);
    return {radius * exact::cos(turn * u), radius * exact::sin(turn * u), 0.7 * exact::sin(turn * v)};
}
std::array<double, 3> pipe(double u, double v)
{
    return {exact::cos(turn * u), exact::sin(turn * u), 4.0 * v};
}

const Points cube_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

Animation animation_of(const Lattice& lattice, std::array<double, 3> (*place)(double, double))
{
    return swaying(lattice.points(place), lattice.triangles());
}

/// Appends a copy of the points, shifted along x; returns the shift of the indices.
std::uint32_t append_shifted(Points& points, double shift)
{
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) points.push_back({points[i][0] + shift, points[i][1], points[i][2]});
    return static_cast<std::uint32_t>(count);
}

} // namespace

Animation tetrahedron()
{
    return swaying({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

Animation torus()
{
    return animation_of({16, 8, true, true}, ring);
}

/// Two tori, a triangle taken out of each, the borders glued vertex by vertex.
Animation double_torus()
{
    const Lattice lattice{12, 7, true, true};
    Points points = lattice.points(ring);
    std::vector<Triangle> triangles = lattice.triangles();
    const std::uint32_t shift = append_shifted(points, 5.4);
    const Triangle hole = triangles.front();
    const std::size_t single = triangles.size();
    for (std::size_t t = 1; t < single; ++t) {
        Triangle copy = triangles[t];
        for (std::uint32_t& v : copy) v += shift;
        // The hole of the copy runs the other way round, so corners 0, 1, 2 meet 0, 2, 1.
        for (std::size_t i = 0; i < 3; ++i)
            for (std::uint32_t& v : copy)
                if (v == hole[i] + shift) v = hole[(3 - i) % 3];
        triangles.push_back(copy);
    }
    triangles.erase(triangles.begin());
    // The three glued vertices of the copy are left over: close the gaps in the numbering.
    for (std::uint32_t gap : {hole[2] + shift, hole[1] + shift, hole[0] + shift}) {
        points.erase(points.begin() + gap);
        for (Triangle& t : triangles)
            for (std::uint32_t& v : t) v -= v > gap ? 1 : 0;
    }
    return swaying(points, triangles);
}

Animation cube_with_hole()
{
    return swaying(
        cube_corners,
        {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}});
}

Animation moebius_strip()
{
    const Lattice lattice{20, 2};
    const auto place = [](double u, double v) -> std::array<double, 3> {
        const double across = v - 0.5, radius = 2.0 + across * exact::cos(0.5 * turn * u);
        return {radius * exact::cos(turn * u), radius * exact::sin(turn * u), across * exact::sin(0.5 * turn * u)};
    };
    Points points;
    for (std::uint32_t i = 0; i < lattice.columns; ++i)
        for (std::uint32_t j = 0; j <= lattice.rows; ++j)
            points.push_back(place(double(i) / lattice.columns, double(j) / lattice.rows));
    const auto index = [&](std::uint32_t i, std::uint32_t j) { return i < lattice.columns ? 3 * i + j : 2 - j; };
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < lattice.columns; ++i)
        for (std::uint32_t j = 0; j < lattice.rows; ++j) {
            triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    return swaying(points, triangles);
}

Animation two_components()
{
    const Lattice lattice{5, 4};
    Points points = lattice.points(flat);
    std::vector<Triangle> triangles = lattice.triangles();
    points.insert(points.begin() + 3, {9, 9, 9}); // isolated vertices at the start, between and at the end
    points.insert(points.begin(), {-9, 0, 1});
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) v += v >= 3 ? 2 : 1;
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const auto& [x, y, z] : cube_corners) points.push_back({x + 7, y, z});
    for (const Triangle& t : cube_with_hole().triangles)
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    points.push_back({3, -9, 0});
    return swaying(points, triangles);
}

Animation bow_tie()
{
    return swaying({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
}

Animation three_on_an_edge()
{
    return swaying({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
}

Animation duplicated_triangles()
{
    const Lattice lattice{4, 3};
    std::vector<Triangle> triangles = lattice.triangles();
    const Triangle a = triangles[0], b = triangles[7], c = triangles[10];
    triangles.push_back(a);                  // as it was
    triangles.push_back({b[1], b[2], b[0]}); // rotated
    triangles.push_back({c[0], c[2], c[1]}); // reversed
    triangles.insert(triangles.begin(), a);
    return swaying(lattice.points(flat), triangles);
}

Animation degenerate_triangles()
{
    const Lattice lattice{4, 3};
    std::vector<Triangle> triangles = lattice.triangles();
    triangles.insert(triangles.begin(), {2, 2, 7});
    triangles.insert(triangles.begin() + 5, {6, 1, 6});
    triangles.push_back({9, 9, 9});
    triangles.push_back({3, 8, 8});
    return swaying(lattice.points(flat), triangles);
}

Animation inconsistent_grid()
{
    const Lattice lattice{6, 5};
    std::vector<Triangle> triangles = lattice.triangles();
    for (std::size_t t = 0; t < triangles.size(); t += 3) std::swap(triangles[t][1], triangles[t][2]);
    return swaying(lattice.points(flat), triangles);
}

Animation one_triangle()
{
    return swaying({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{2, 0, 1}});
}

Animation one_frame()
{
    const Lattice lattice{5, 5};
    return swaying(lattice.points(flat), lattice.triangles(), 1);
}

Animation no_motion()
{
    Animation animation = torus();
    for (std::size_t f = 1; f < animation.frame_count(); ++f)
        for (std::size_t i = 0; i < animation.frame(0).size(); ++i) animation.frame(f)[i] = animation.frame(0)[i];
    return animation;
}

Animation random_soup()
{
    Random random(11);
    Points points;
    for (int v = 0; v < 40; ++v) points.push_back({random.uniform(), random.uniform(), random.uniform()});
    std::vector<Triangle> triangles(200);
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.below(points.size()));
    return swaying(points, triangles);
}

Animation split_seam()
{
    const Lattice lattice{10, 6};
    Points points = lattice.points(pipe);
    for (std::uint32_t j = 0; j <= lattice.rows; ++j) points[lattice.index(10, j)] = points[lattice.index(0, j)];
    return swaying(points, lattice.triangles());
}

Animation points_only()
{
    return swaying(cube_corners, {});
}

std::vector<Named> all()
{
    return {
        {"tetrahedron", tetrahedron()},
        {"torus", torus()},
        {"double_torus", double_torus()},
        {"cube_with_hole", cube_with_hole()},
        {"moebius_strip", moebius_strip()},
        {"two_components", two_components()},
        {"bow_tie", bow_tie()},
        {"three_on_an_edge", three_on_an_edge()},
        {"duplicated_triangles", duplicated_triangles()},
        {"degenerate_triangles", degenerate_triangles()},
        {"inconsistent_grid", inconsistent_grid()},
        {"one_triangle", one_triangle()},
        {"one_frame", one_frame()},
        {"no_motion", no_motion()},
        {"random_soup", random_soup()},
        {"split_seam", split_seam()},
        {"points_only", points_only()},
    };
}

} // namespace meshreel::test_shapes
