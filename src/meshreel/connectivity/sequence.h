/// A triangle list coded in its own order, vertex by vertex: what keeps every number as it was.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/coding/range_coder.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::connectivity {

/// Corner after corner: is it one of the vertices that the triangles before suggest, or else how far from one?
/// Any list is taken. @cost O(T).
void write_sequence(coding::RangeEncoder& coder, std::uint32_t vertex_count, std::span<const Triangle> triangles);

/// @fails bad_input: cut, or an index out of range.
Result<std::vector<Triangle>> read_sequence(coding::RangeDecoder& coder, std::uint32_t vertex_count,
                                            std::uint32_t triangle_count);

} // namespace meshreel::connectivity
