/// The way back from Edgebreaker's numbering to the input's: triangle after triangle, as a walk over the known mesh.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/coding/range_coder.h"
#include "meshreel/connectivity/shell.h"

namespace meshreel::connectivity {

/// Writes the order that a shell has lost: which triangle is next, its first corner, the numbers of its new vertices.
/// @param shelled as shell_of() made it.  @cost O(T log T).
void write_order(coding::RangeEncoder& coder, std::uint32_t vertex_count, const Shelled& shelled);

/// @param triangles  as triangles_of() made them.
/// @return [T] the triangles in their own order, over the input's vertices. @fails bad_input: cut, malformed.
Result<std::vector<Triangle>> read_order(coding::RangeDecoder& coder, std::uint32_t vertex_count,
                                         std::span<const Triangle> triangles);

} // namespace meshreel::connectivity
