/// Charts of a surface: the parts between its seams.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel {

/// A number for every corner, equal where two corners agree in everything: their vertex and the values of all attributes
/// of corners. Corners of one vertex that differ lie on a seam.
std::vector<std::uint32_t> wedges_of(std::span<const Triangle> triangles, const Appearance& appearance);

/// The chart of every triangle, [T]: triangles are in one chart if an edge joins them at whose both ends their wedges agree,
/// or others do so in between. A chart is named by its first triangle.
/// @param triangles over vertices as the surface sees them, welded.  @param wedges [3T].  @cost O(T log T).
std::vector<std::uint32_t> charts_of(std::span<const Triangle> triangles, std::span<const std::uint32_t> wedges);

} // namespace meshreel
