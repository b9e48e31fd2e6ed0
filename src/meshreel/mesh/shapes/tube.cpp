/// Tubes and paths.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/shapes/tube.h"

#include <algorithm>

#include "meshreel/base/exact.h"

namespace meshreel::shapes {

namespace {

struct Rings {
    std::uint32_t count, segments;
    std::uint32_t index(std::uint32_t ring, std::uint32_t segment) const
    {
        return 1 + ring * segments + segment % segments;
    }
    std::uint32_t nose() const { return 0; }
    std::uint32_t tail() const { return 1 + count * segments; }
};

Rings rings_for(std::uint32_t vertices, double around)
{
    const auto even = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(vertices - 2) * around));
    const std::uint32_t segments = std::clamp<std::uint32_t>(even, 3, (vertices - 2) / 2);
    return {(vertices - 2) / segments, segments};
}

std::vector<Triangle> tube_triangles(const Rings& rings)
{
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < rings.segments; ++i) {
        triangles.push_back({rings.nose(), rings.index(0, i + 1), rings.index(0, i)});
        for (std::uint32_t r = 0; r + 1 < rings.count; ++r) {
            triangles.push_back({rings.index(r, i), rings.index(r + 1, i + 1), rings.index(r + 1, i)});
            triangles.push_back({rings.index(r, i), rings.index(r, i + 1), rings.index(r + 1, i + 1)});
        }
        triangles.push_back({rings.tail(), rings.index(rings.count - 1, i), rings.index(rings.count - 1, i + 1)});
    }
    return triangles;
}

} // namespace

Body tube(std::uint32_t vertices, double around, const std::function<Vec(double, double)>& place)
{
    const Rings rings = rings_for(vertices, around);
    Body body;
    body.points.push_back(place(0.0, 0.0));
    for (std::uint32_t r = 0; r < rings.count; ++r) {
        const double even = static_cast<double>(r + 1) / (rings.count + 1);
        const double s = 0.3 * (even * even * (3.0 - 2.0 * even)) + 0.7 * even; // closer at the ends, where it is round
        for (std::uint32_t i = 0; i < rings.segments; ++i)
            body.points.push_back(place(s, static_cast<double>(i) / rings.segments));
    }
    body.points.push_back(place(1.0, 0.0));
    body.triangles = tube_triangles(rings);
    split_edges(body, vertices);
    return body;
}

Path::Path(const std::function<double(double)>& heading, double first, double last) : first_(first), step_(1.0 / 128.0)
{
    Vec position{};
    for (double u = first; u < last + 2.0 * step_; u += step_) {
        const double angle = heading(u);
        const Vec forward{exact::cos(angle), 0.0, -exact::sin(angle)};
        places_.push_back({position, forward, {exact::sin(angle), 0.0, exact::cos(angle)}});
        const double middle = heading(u + 0.5 * step_); // midpoint rule
        position = position + step_ * Vec{exact::cos(middle), 0.0, -exact::sin(middle)};
    }
}

Path::Place Path::at(double u) const
{
    const double steps = (u - first_) / step_;
    const auto before = std::clamp<long long>(exact::floor(steps), 0, static_cast<long long>(places_.size()) - 2);
    const double t = steps - static_cast<double>(before);
    const Place &a = places_[static_cast<std::size_t>(before)], &b = places_[static_cast<std::size_t>(before) + 1];
    const auto between = [t](const Vec& from, const Vec& to) { return from + t * (to - from); };
    return {between(a.position, b.position), between(a.forward, b.forward), between(a.side, b.side)};
}

} // namespace meshreel::shapes
