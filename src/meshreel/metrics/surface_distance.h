/// How far points are from a surface.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/mesh/animation.h"
#include "meshreel/metrics/point.h"

namespace meshreel::metrics {

using TriangleCorners = std::array<Point, 3>; ///< of a triangle, which may be degenerate

/// The point of a triangle that is nearest to a point. @cost some twenty products
Point nearest_point(const Point& point, const TriangleCorners& corners);

/// Squared distance of a point to a triangle, which may be degenerate; exactly 0 at its corners.
double squared_distance_to_triangle(const Point& point, const TriangleCorners& corners);

/// One frame of a surface, in boxes, so that the nearest of its points is found quickly.
///
/// A tree whose nodes have up to four children; the boxes are floats, as the positions are, and a query keeps a margin
/// for its own rounding, so no triangle is missed. Distances are in double precision.
class SurfaceDistance {
public:
    using Point = metrics::Point;

    /// Where the tree keeps a triangle.
    using Place = std::uint32_t;

    struct Nearest {
        double squared; ///< distance, squared model units
        Place place;
    };

    /// triangles: [T], any; positions: [V x 3]; both are copied. @cost O(T log T).
    SurfaceDistance(std::span<const Triangle> triangles, std::span<const float> positions);

    bool empty() const { return corners_.empty(); }
    std::size_t size() const { return corners_.size(); } ///< T; places are 0 .. T-1

    /// Squared distance to the nearest point of any triangle, squared model units; infinite where there is no triangle.
    /// @cost O(log T) mostly.
    double squared(const Point& point) const;

    /// The same and which triangle has it. The search is short where `guess` is near, as the nearest triangle of a point
    /// nearby is; the distance never depends on the guess. @pre not empty
    Nearest nearest(const Point& point, Place guess = 0) const;

    Place place_of(std::uint32_t triangle) const { return places_[triangle]; }
    std::uint32_t triangle_at(Place place) const { return triangles_[place]; }
    TriangleCorners corners(Place place) const;

    /// Four children side by side.
    struct Node {
        std::array<std::array<float, 4>, 3> low, high;
        std::array<std::uint32_t, 4> children; ///< a node, or leaf + a place, or none
    };
    static constexpr std::uint32_t none = 0xffffffff, leaf = 0x80000000;

private:
    std::vector<std::array<float, 9>> corners_; ///< by place
    std::vector<Place> places_;                 ///< by triangle
    std::vector<std::uint32_t> triangles_;      ///< by place
    std::vector<Node> nodes_;                   ///< the first is the root
};

} // namespace meshreel::metrics
