/// Made surfaces for the tests of distances between surfaces.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "meshreel/base/random.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/surface_bounds.h"

namespace meshreel::metrics::test {

struct Surface {
    std::vector<Triangle> triangles;
    std::vector<float> positions;

    SurfaceDistance tree() const { return {triangles, positions}; }
    Point vertex(std::uint32_t v) const { return {positions[3ul * v], positions[3ul * v + 1], positions[3ul * v + 2]}; }
};

/// A sphere around the origin, of n bands; corners on it, so triangles are a little inside.
inline Surface sphere(std::uint32_t n, double radius)
{
    Surface made;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j < 2 * n; ++j) {
            const double down = M_PI * i / n, around = M_PI * j / n;
            for (double x : {std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)})
                made.positions.push_back(static_cast<float>(radius * x));
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < 2 * n; ++j) {
            const std::uint32_t a = 2 * n * i + j, b = 2 * n * i + (j + 1) % (2 * n);
            made.triangles.push_back({a, b, a + 2 * n});
            made.triangles.push_back({b, b + 2 * n, a + 2 * n});
        }
    return made;
}

/// A square 0 .. 1 x 0 .. 1 of n x n cells at a height.
inline Surface square(std::uint32_t n, float height)
{
    Surface made;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            for (float x : {float(j) / float(n), float(i) / float(n), height}) made.positions.push_back(x);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j;
            made.triangles.push_back({a, a + 1, a + n + 1});
            made.triangles.push_back({a + 1, a + n + 2, a + n + 1});
        }
    return made;
}

inline Surface surface_of(const Animation& animation)
{
    return {animation.triangles, {animation.frame(0).begin(), animation.frame(0).end()}};
}

inline Surface noisy(Surface surface, double amplitude, std::uint64_t seed = 7)
{
    Random random(seed);
    for (float& x : surface.positions) x += static_cast<float>(random.uniform(-amplitude, amplitude));
    return surface;
}

inline DistanceBounds bounds(const Surface& from, const Surface& to, const BoundOptions& options)
{
    const SurfaceDistance a = from.tree(), b = to.tree();
    return bound_distance({from.triangles, from.positions, a}, b, options);
}

inline double no_tree_distance(const Point& p, const Surface& to)
{
    double least = HUGE_VAL;
    for (const auto& [i, j, k] : to.triangles)
        least = std::min(least, squared_distance_to_triangle(p, {to.vertex(i), to.vertex(j), to.vertex(k)}));
    return std::sqrt(least);
}

} // namespace meshreel::metrics::test
