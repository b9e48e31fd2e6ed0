/// Which triangle lies across which edge, for any triangle list: consistently oriented where that is possible.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::connectivity {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Half-edge h = 3 t + i runs from corner i of triangle t to its next corner.
constexpr std::uint32_t next_half(std::uint32_t h)
{
    return h % 3 == 2 ? h - 2 : h + 1;
}
constexpr std::uint32_t previous_half(std::uint32_t h)
{
    return h % 3 == 0 ? h + 2 : h - 1;
}

/// The triangles turned so that neighbours agree, and their neighbours.
struct Adjacency {
    std::vector<Triangle> triangles;   ///< [T] as given, but corners 1 and 2 exchanged where flipped
    std::vector<std::uint8_t> flipped; ///< [T]
    std::vector<std::uint32_t> twin;   ///< [3T] the half-edge that runs the other way, or none

    /// The corner of the input (3 t + i) that stands at corner h of the turned triangles.
    std::uint32_t input_corner(std::uint32_t h) const
    {
        return h % 3 != 0 && flipped[h / 3] != 0 ? h - h % 3 + 3 - h % 3 : h;
    }
    /// The vertex where half-edge h begins.
    std::uint32_t from(std::uint32_t h) const { return triangles[h / 3][h % 3]; }
};

/// True if a vertex occurs twice.
constexpr bool degenerate(const Triangle& t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Triangles are neighbours across an edge that exactly two of them have; degenerate triangles have no neighbours.
/// The first triangle of each component stands as it is, others are flipped to agree; where that cannot be done
/// (a Moebius strip) the edge is cut. @param vertex_count above every index. @cost O(T log of the largest degree).
Adjacency adjacency(std::uint32_t vertex_count, std::span<const Triangle> triangles);

} // namespace meshreel::connectivity
