/// What the Edgebreaker payload holds: a string, what its vertices are, which triangles were flipped.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshreel/base/limits.h"
#include "meshreel/base/result.h"
#include "meshreel/coding/range_coder.h"
#include "meshreel/connectivity/edgebreaker.h"

namespace meshreel::connectivity {

/// A triangle list up to its numbering and each triangle's first corner.
struct Shell {
    static constexpr std::uint32_t fresh = 0xffffffff, dummy = 0xfffffffe;

    std::uint32_t triangle_count = 0; ///< T
    ClersString string;               ///< of the closed mesh
    std::vector<std::uint32_t>
        copies; ///< [copies] in the order met: fresh, dummy, or the earlier vertex it is glued to
    std::vector<std::uint8_t> flipped; ///< [T] in the order of conquest: stands the other way round in the list
};

/// A shell, and where its triangles' corners and its vertices stood.
struct Shelled {
    Shell shell;
    std::vector<std::uint32_t> vertex_of; ///< [vertices with a triangle] input vertex by shell number
    std::vector<std::uint32_t> corner_of; ///< [3T] input corner of each corner of triangles_of(shell)
};

/// Nothing where conquer() gives up.
std::optional<Shelled> shell_of(std::uint32_t vertex_count, std::span<const Triangle> triangles);

/// The real triangles in the order of conquest, oriented as they were; vertices numbered as met.
/// @fails bad_input: the string or the copies describe no mesh.
Result<std::vector<Triangle>> triangles_of(const Shell& shell);

/// @param shell.triangle_count is known to both sides.
void write(coding::RangeEncoder& coder, const Shell& shell);
/// @param most_closed  triangles that the closed mesh may have, holes filled; 70 bytes each are allocated.
/// @fails bad_input: cut, malformed, more than most_closed.
Result<Shell> read(coding::RangeDecoder& coder, std::uint32_t triangle_count, std::uint64_t most_closed);

} // namespace meshreel::connectivity
