/// A coarser surface over some of the vertices: the dual of the Voronoi diagram that they make along the surface.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

/// Triangles between kept vertices.
struct CoarseSurface {
    std::vector<Triangle> triangles;        ///< [T'] places in `kept`
    std::vector<std::uint32_t> triangle_of; ///< [T'] the triangle that each came from, rising
};

/// Every other vertex joins the kept one that is nearest along edges, never across a third kept one; a triangle whose corners have joined three different
/// ones stays, as a triangle of those.
///
///     a a a|b b b
///     a a a|b b b      three cells meet in one triangle: a b c
///     a a/c c\b b
///     c c c c c c
///
/// Orientation stays; of triangles that would go round the same three vertices in the same direction only the first
/// stays. What is closed stays closed: along the border of two cells, one of these triangles lies at each end. A part
/// without a kept vertex goes, and one that is thinner than the cells are wide becomes flat or goes.
///
/// X [V x 3]: where the vertices are; lengths are of any scale. kept: vertices, each at most once. Of equally near ones
/// the first in `kept` is joined. Only + - * / sqrt in a fixed order: the same on every machine.
/// @cost O((V + T) log V).
CoarseSurface coarse_surface(std::span<const Triangle> triangles, MatrixView<const double> X,
                             std::span<const std::uint32_t> kept);

} // namespace meshreel
