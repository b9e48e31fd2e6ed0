/// Some of a surface's vertices with the triangles between them, and what is left of its appearance.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

/// A triangle list and which of its vertices are one: doubled ones along seams.
struct WeldedSurface {
    std::uint32_t count = 0;                   ///< W, of vertices once welded
    std::span<const Triangle> triangles;       ///< [T] over V
    std::span<const std::uint32_t> surface_of; ///< [V] the welded vertex of each, 0 .. W-1
};

/// V' vertices and T' triangles of it.
struct SurfacePart {
    std::vector<std::uint32_t> wanted;      ///< [V'] the welded vertex of each
    std::vector<std::uint32_t> vertex_of;   ///< [V'] its number in the whole, rising
    std::vector<Triangle> triangles;        ///< [T'] over 0 .. V'-1
    std::vector<std::uint32_t> triangle_of; ///< [T'] the triangle of the whole that each came from, rising
    std::vector<std::uint32_t> corner_of;   ///< [3T'] the corner of the whole whose values each has
};

/// The coarse surface (mesh/coarse_surface.h) over the kept ones of the welded vertices. Along a seam, a triangle's corner is at
/// the one of the doubled vertices on the triangle's own side. places [W x 3]; kept: each once,
/// in any order.
SurfacePart surface_part(const WeldedSurface& surface, const Appearance& appearance, MatrixView<const double> places,
                         std::span<const std::uint32_t> kept);

/// What is left of an appearance: values of vertices and triangles stay with those that they belong to; a corner has those
/// of a corner at the same vertex in the chart (mesh/charts.h) of the triangle that its own came from, or, where the vertex is outside
/// that chart, of that triangle's corner, which is near.
Appearance appearance_of(const SurfacePart& part, const Appearance& appearance);

} // namespace meshreel
