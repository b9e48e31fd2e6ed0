/// How far points are from a surface.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::metrics {

/// One frame of a surface, in boxes, so that the nearest of its points is found quickly.
class SurfaceDistance {
public:
    using Point = std::array<double, 3>;

    /// triangles: [T], any; positions: [V x 3]. Both must outlive it. @cost O(T log T).
    SurfaceDistance(std::span<const Triangle> triangles, std::span<const float> positions);

    /// Squared distance to the nearest point of any triangle, squared model units; infinite where there is no triangle.
    /// @cost O(log T) mostly.
    double squared(const Point& point) const;

private:
    struct Box {
        Point low, high;
    };
    struct Node {
        Box box;
        std::uint32_t begin = 0, end = 0;  ///< into order_, of a leaf
        std::uint32_t left = 0, right = 0; ///< nodes; 0 of a leaf
    };

    Point corner(std::uint32_t t, std::size_t i) const;
    Box box_of(std::uint32_t t) const;
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);
    void visit(std::uint32_t node, const Point& point, double& best) const;

    std::span<const Triangle> triangles_;
    std::span<const float> positions_;
    std::vector<std::uint32_t> order_; ///< triangles
    std::vector<Node> nodes_;          ///< the first is the root
};

/// Squared distance of a point to a triangle, which may be degenerate.
double squared_distance_to_triangle(const SurfaceDistance::Point& point,
                                    const std::array<SurfaceDistance::Point, 3>& corners);

} // namespace meshreel::metrics
