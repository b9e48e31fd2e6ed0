/// The still surfaces that generators move: grids, tubes, and the way to an exact vertex count.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshreel/mesh/animation.h"
#include "meshreel/mesh/shapes.h"

namespace meshreel::shapes {

/// A surface at rest.
struct Body {
    std::vector<std::array<double, 3>> points; ///< [V]
    std::vector<std::array<double, 2>> uv;     ///< [V], in [0, 1]; empty: none
    std::vector<Triangle> triangles;           ///< [T]
};

/// A flat grid of columns x rows vertices over [0, width] x [0, height] at z = 0, with UVs; its diagonals alternate.
struct GridSize {
    std::uint32_t columns, rows;
    double width, height;
};
Body grid(const GridSize& size);

/// The grid with at most `vertices` vertices whose cells are nearest to squares.
GridSize grid_size(std::uint32_t vertices, double width, double height);

/// Splits the longest edges at their middle, each time by one vertex, until there are exactly `vertices`. Splits are
/// spread: no triangle is split twice before every other has had its turn.
void split_edges(Body& body, std::uint32_t vertices);

/// An animation of that body with F frames to be filled: triangles, times, and "uv0" where the body has it.
Animation animation_of(const Body& body, const ShapeOptions& options);

/// An attribute with a number for each triangle: "group", "material".
Attribute triangle_numbers(const char* name, const std::vector<std::uint32_t>& numbers);

} // namespace meshreel::shapes
