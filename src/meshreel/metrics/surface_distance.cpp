/// A tree of boxes over triangles; the nearer child is looked into first.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/surface_distance.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace meshreel::metrics {

namespace {

using Point = SurfaceDistance::Point;

constexpr std::uint32_t triangles_a_leaf = 4;

Point minus(const Point& a, const Point& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Point& a, const Point& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point cross(const Point& a, const Point& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double squared_distance_to_segment(const Point& p, const Point& a, const Point& b)
{
    const Point along = minus(b, a), from = minus(p, a);
    const double length = dot(along, along);
    const double t = length > 0 ? std::clamp(dot(from, along) / length, 0.0, 1.0) : 0.0;
    const Point rest{from[0] - t * along[0], from[1] - t * along[1], from[2] - t * along[2]};
    return dot(rest, rest);
}

} // namespace

double squared_distance_to_triangle(const Point& point, const std::array<Point, 3>& corners)
{
    const auto& [a, b, c] = corners;
    const Point normal = cross(minus(b, a), minus(c, a));
    const double area = dot(normal, normal);
    const auto inside = [&](const Point& from, const Point& to) {
        return dot(cross(minus(to, from), minus(point, from)), normal) >= 0;
    };
    if (area > 0 && inside(a, b) && inside(b, c) && inside(c, a)) {
        const double height = dot(minus(point, a), normal);
        return height * height / area;
    }
    return std::min({squared_distance_to_segment(point, a, b), squared_distance_to_segment(point, b, c),
                     squared_distance_to_segment(point, c, a)});
}

SurfaceDistance::SurfaceDistance(std::span<const Triangle> triangles, std::span<const float> positions)
    : triangles_(triangles), positions_(positions), order_(triangles.size())
{
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

double SurfaceDistance::squared(const Point& point) const
{
    double best = std::numeric_limits<double>::infinity();
    if (!nodes_.empty()) visit(0, point, best);
    return best;
}

Point SurfaceDistance::corner(std::uint32_t t, std::size_t i) const
{
    const float* p = positions_.data() + 3ul * triangles_[t][i];
    return {p[0], p[1], p[2]};
}

SurfaceDistance::Box SurfaceDistance::box_of(std::uint32_t t) const
{
    Box box{corner(t, 0), corner(t, 0)};
    for (std::size_t i = 1; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            box.low[c] = std::min(box.low[c], corner(t, i)[c]);
            box.high[c] = std::max(box.high[c], corner(t, i)[c]);
        }
    return box;
}

/// Halves along the longest side of the box.
std::uint32_t SurfaceDistance::build(std::uint32_t begin, std::uint32_t end)
{
    Box box = box_of(order_[begin]);
    for (std::uint32_t i = begin + 1; i < end; ++i) {
        const Box one = box_of(order_[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            box.low[c] = std::min(box.low[c], one.low[c]);
            box.high[c] = std::max(box.high[c], one.high[c]);
        }
    }
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({box, begin, end});
    if (end - begin <= triangles_a_leaf) return node;
    const Point sides = minus(box.high, box.low);
    const auto axis = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
    const auto middle = [&](std::uint32_t t) { return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]; };
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
    const std::uint32_t left = build(begin, half), right = build(half, end);
    nodes_[node].left = left;
    nodes_[node].right = right;
    return node;
}

void SurfaceDistance::visit(std::uint32_t index, const Point& point, double& best) const
{
    const Node& node = nodes_[index];
    if (node.left == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const std::uint32_t t = order_[i];
            best = std::min(best, squared_distance_to_triangle(point, {corner(t, 0), corner(t, 1), corner(t, 2)}));
        }
        return;
    }
    const auto away = [&](const Box& box) {
        double sum = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double outside = std::max({box.low[c] - point[c], point[c] - box.high[c], 0.0});
            sum += outside * outside;
        }
        return sum;
    };
    std::array children{std::pair(away(nodes_[node.left].box), node.left),
                        std::pair(away(nodes_[node.right].box), node.right)};
    if (children[1] < children[0]) std::swap(children[0], children[1]);
    for (const auto& [distance, child] : children)
        if (distance < best) visit(child, point, best);
}

} // namespace meshreel::metrics
