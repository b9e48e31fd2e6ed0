/// A tree of boxes over triangles, four children a node; the nearest child is looked into first.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace meshreel::metrics {

namespace {

/// Below this sine, squared, of the angle at its first corner a triangle is a sliver: its three sides are looked at too.
constexpr double sliver_angle = 1e-6;

using Node = SurfaceDistance::Node;
constexpr float far_away = std::numeric_limits<float>::infinity();

struct FloatBox {
    std::array<float, 3> low{far_away, far_away, far_away}, high{-far_away, -far_away, -far_away};

    void add(const FloatBox& other)
    {
        for (std::size_t c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], other.low[c]);
            high[c] = std::max(high[c], other.high[c]);
        }
    }
};

struct TreeItem {
    std::array<float, 3> middle; ///< of the triangle's box
    std::uint32_t triangle;
};

/// Halves the triangles along the longest side of the box of their middles, again and again.
class TreeBuilder {
public:
    TreeBuilder(std::span<const Triangle> triangles, std::span<const float> positions)
        : triangles_(triangles), positions_(positions)
    {
        items.resize(triangles.size());
        for (std::uint32_t t = 0; t < items.size(); ++t) {
            const FloatBox box = box_of(t);
            for (std::size_t c = 0; c < 3; ++c) items[t].middle[c] = box.low[c] / 2 + box.high[c] / 2;
            items[t].triangle = t;
        }
        nodes.reserve(items.size() / 2 + 1);
        build(0, static_cast<std::uint32_t>(items.size()));
    }

    std::vector<TreeItem> items; ///< by place
    std::vector<Node> nodes;

private:
    FloatBox box_of(std::uint32_t t) const
    {
        FloatBox box;
        for (const std::uint32_t v : triangles_[t]) {
            const std::array<float, 3> p{positions_[3ul * v], positions_[3ul * v + 1], positions_[3ul * v + 2]};
            box.add({p, p});
        }
        return box;
    }

    std::uint32_t halve(std::uint32_t begin, std::uint32_t end)
    {
        FloatBox box;
        for (std::uint32_t i = begin; i < end; ++i) box.add({items[i].middle, items[i].middle});
        std::size_t axis = 0;
        for (std::size_t c = 1; c < 3; ++c)
            if (box.high[c] - box.low[c] > box.high[axis] - box.low[axis]) axis = c;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(items.begin() + begin, items.begin() + middle, items.begin() + end,
                         [axis](const TreeItem& a, const TreeItem& b) { return a.middle[axis] < b.middle[axis]; });
        return middle;
    }

    /// Makes the node of the triangles begin .. end - 1 and returns their box. Recursion is as deep as log4 T.
    FloatBox build(std::uint32_t begin, std::uint32_t end)
    {
        std::array<std::uint32_t, 5> cuts{begin, begin + 1, begin + 2, begin + 3, end};
        if (end - begin > 4) {
            cuts[2] = halve(begin, end);
            cuts[1] = halve(begin, cuts[2]);
            cuts[3] = halve(cuts[2], end);
        }
        const std::size_t node = nodes.size();
        nodes.emplace_back();
        FloatBox all;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t first = std::min(cuts[i], end), last = std::min(cuts[i + 1], end);
            const std::uint32_t child = last == first       ? SurfaceDistance::none
                                        : last - first == 1 ? SurfaceDistance::leaf + first
                                                            : static_cast<std::uint32_t>(nodes.size());
            FloatBox box;
            if (last - first == 1) box = box_of(items[first].triangle);
            if (last - first > 1) box = build(first, last);
            nodes[node].children[i] = child;
            for (std::size_t c = 0; c < 3; ++c) {
                nodes[node].low[c][i] = box.low[c];
                nodes[node].high[c][i] = box.high[c];
            }
            all.add(box);
        }
        return all;
    }

    std::span<const Triangle> triangles_;
    std::span<const float> positions_;
};

typedef float FourFloats __attribute__((vector_size(16)));

FourFloats four(const std::array<float, 4>& values)
{
    FourFloats all;
    std::memcpy(&all, values.data(), sizeof(all));
    return all;
}

/// A point in floats, as the two ends of an interval that its coordinates surely are in; four times side by side.
struct Query {
    explicit Query(const Point& p)
    {
        for (std::size_t c = 0; c < 3; ++c) {
            const double margin = 4.0e-7 * std::abs(p[c]);
            const auto under = static_cast<float>(p[c] - margin), over = static_cast<float>(p[c] + margin);
            low[c] = FourFloats{under, under, under, under};
            high[c] = FourFloats{over, over, over, over};
        }
    }
    std::array<FourFloats, 3> low, high;
};

/// What a box may at most be away for its triangles to be looked at: the rounding of floats is on the safe side.
float reach(double squared)
{
    return static_cast<float>(squared * 1.000002) + std::numeric_limits<float>::min();
}

/// Squared distances from the four boxes of a node, a little too short.
inline FourFloats squared_from_boxes(const Node& node, const Query& query)
{
    FourFloats sum{};
    for (std::size_t c = 0; c < 3; ++c) {
        const FourFloats under = four(node.low[c]) - query.high[c], over = query.low[c] - four(node.high[c]), zero{};
        FourFloats outside = under > over ? under : over;
        outside = outside > zero ? outside : zero;
        sum += outside * outside;
    }
    return sum;
}

/// The boxes still to be looked into, the nearest on top.
class Agenda {
public:
    struct Entry {
        float squared;
        std::uint32_t child;
    };

    bool empty() const { return size_ == 0; }
    Entry pop() { return entries_[--size_]; }

    /// Puts the children of a node that are within reach on top, the nearest last.
    void add(const Node& node, const FourFloats& squared, float limit)
    {
        const std::size_t floor = size_;
        for (std::size_t i = 0; i < 4; ++i) {
            if (squared[i] > limit || node.children[i] == SurfaceDistance::none) continue;
            std::size_t at = size_++;
            for (; at > floor && entries_[at - 1].squared < squared[i]; --at) entries_[at] = entries_[at - 1];
            entries_[at] = {squared[i], node.children[i]};
        }
    }

private:
    std::array<Entry, 64> entries_; ///< three a level of the tree and one: 2^31 triangles are 16 levels
    std::size_t size_ = 0;
};

Point nearest_point_of_segment(const Point& p, const Point& a, const Point& b)
{
    const Point along = minus(b, a);
    const double length = dot(along, along), t = dot(minus(p, a), along);
    if (t <= 0 || length <= 0) return a;
    if (t >= length) return b;
    return between(a, b, t / length);
}

/// The point of the triangle that projects to a point of its plane, where that is within.
///   normal: of the triangle; area: its squared length
Point nearest_inner_point(const Point& p, const TriangleCorners& corners, const Point& normal, double area)
{
    const auto& [a, b, c] = corners;
    const Point ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
    const double v = std::clamp(dot(cross(ap, ac), normal) / area, 0.0, 1.0);
    const double w = std::clamp(dot(cross(ab, ap), normal) / area, 0.0, 1.0 - v);
    return plus(a, plus(times(v, ab), times(w, ac)));
}

/// The regions of a sliver are lost in rounding, but its points are all near its sides.
Point nearest_point_of_sliver(const Point& p, const TriangleCorners& corners, const Point& normal, double area)
{
    const auto& [a, b, c] = corners;
    const std::array<Point, 4> points{nearest_point_of_segment(p, a, b), nearest_point_of_segment(p, b, c),
                                      nearest_point_of_segment(p, c, a),
                                      area > 0 ? nearest_inner_point(p, corners, normal, area) : a};
    return *std::ranges::min_element(points, {}, [&](const Point& q) { return squared_distance(p, q); });
}

} // namespace

/// By the region of the triangle's plane in which the point lies (Ericson, Real-Time Collision Detection, 5.1.5).
Point nearest_point(const Point& p, const TriangleCorners& corners)
{
    const auto& [a, b, c] = corners;
    const Point ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Point bp = minus(p, b);
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const Point cp = minus(p, c);
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const Point normal = cross(ab, ac);
    const double area = dot(normal, normal);
    if (area <= sliver_angle * dot(ab, ab) * dot(ac, ac)) return nearest_point_of_sliver(p, corners, normal, area);
    if (d1 >= 0 && d3 <= 0 && dot(cross(ab, ap), normal) <= 0) return between(a, b, d1 / (d1 - d3));
    if (d2 >= 0 && d6 <= 0 && dot(cross(ap, ac), normal) <= 0) return between(a, c, d2 / (d2 - d6));
    if (d4 >= d3 && d5 >= d6 && dot(cross(bp, cp), normal) <= 0)
        return between(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return nearest_inner_point(p, corners, normal, area);
}

double squared_distance_to_triangle(const Point& point, const TriangleCorners& corners)
{
    return squared_distance(point, nearest_point(point, corners));
}

SurfaceDistance::SurfaceDistance(std::span<const Triangle> triangles, std::span<const float> positions)
    : corners_(triangles.size()), places_(triangles.size()), triangles_(triangles.size())
{
    if (triangles.empty()) return;
    TreeBuilder builder(triangles, positions);
    nodes_ = std::move(builder.nodes);
    for (Place place = 0; place < corners_.size(); ++place) {
        const std::uint32_t t = builder.items[place].triangle;
        places_[t] = place;
        triangles_[place] = t;
        for (std::size_t i = 0; i < 9; ++i) corners_[place][i] = positions[3ul * triangles[t][i / 3] + i % 3];
    }
}

double SurfaceDistance::squared(const Point& point) const
{
    return empty() ? std::numeric_limits<double>::infinity() : nearest(point).squared;
}

TriangleCorners SurfaceDistance::corners(Place place) const
{
    const std::array<float, 9>& x = corners_[place];
    return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}}};
}

SurfaceDistance::Nearest SurfaceDistance::nearest(const Point& point, Place guess) const
{
    Nearest best{squared_distance_to_triangle(point, corners(guess)), guess};
    float limit = reach(best.squared);
    const Query query(point);
    Agenda agenda;
    agenda.add(nodes_[0], squared_from_boxes(nodes_[0], query), limit);
    while (!agenda.empty() && best.squared > 0) {
        const Agenda::Entry entry = agenda.pop();
        if (entry.squared > limit) continue;
        if (entry.child < leaf) {
            agenda.add(nodes_[entry.child], squared_from_boxes(nodes_[entry.child], query), limit);
            continue;
        }
        const Place place = entry.child - leaf;
        const double squared = squared_distance_to_triangle(point, corners(place));
        if (squared >= best.squared) continue;
        best = {squared, place};
        limit = reach(squared);
    }
    return best;
}

} // namespace meshreel::metrics
