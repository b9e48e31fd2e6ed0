/// Edgebreaker: a closed mesh as a string over C L E R S, and back. Thesis 3.2.2.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/connectivity/closed_mesh.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::connectivity {

/// What the tip of the triangle beyond the gate is: a new vertex (C), the border's next one to the left (L) or right
/// (R), both at once (E), or anywhere else on a border (S).
enum class Clers : std::uint8_t { C, L, E, R, S };

/// An S whose tip lies on a border that waits in the stack: two borders become one, as happens once a handle.
struct Merge {
    std::uint32_t symbol = 0;   ///< which symbol of the string
    std::uint32_t depth = 0;    ///< of the other border in the stack, 0 the top
    std::uint32_t position = 0; ///< of the tip, in edges to the right of that border's gate
    std::uint32_t length = 0;   ///< of that border, edges
};

/// A closed mesh without its vertices' names. The first triangle of each component has no symbol.
struct ClersString {
    std::uint32_t triangle_count = 0; ///< T', symbols and components together
    std::vector<Clers> symbols;
    std::vector<Merge> merges; ///< by rising symbol

    /// Bits before entropy coding: one for C, three for the others (3.30).
    std::uint64_t raw_bits() const;
};

/// What the encoder found.
struct Conquest {
    ClersString string;
    std::vector<std::uint32_t> half_of; ///< [T'] half-edge by which each triangle was entered, in the order of conquest
    std::vector<std::uint32_t> copies;  ///< copies of the closed mesh in the order met
};

/// Conquers a closed mesh, each component from its first triangle. Nothing if many handles would cost the decoder
/// more than its work budget. @cost O(T' log T') without handles.
std::optional<Conquest> conquer(const ClosedMesh& mesh);

/// The triangles that a string describes, in the order of conquest, each from its gate; vertices numbered as met.
/// @fails bad_input: the string describes no mesh, or takes more steps than the work budget of 64 a triangle.
/// @cost O(T' log T') without merges, O(64 T') at most; 45 bytes a triangle.
Result<std::vector<Triangle>> rebuild(const ClersString& string);

} // namespace meshreel::connectivity
