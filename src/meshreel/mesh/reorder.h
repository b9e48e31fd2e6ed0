/// An animation with its vertices and triangles in another order.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "meshreel/mesh/animation.h"

namespace meshreel {

/// A new order: vertex i was vertex_of[i], corner 3 t + j was corner_of[3 t + j]. Both are permutations, and the three
/// corners of a triangle stay together in their cyclic order.
struct NewOrder {
    std::span<const std::uint32_t> vertex_of; ///< [V]
    std::span<const std::uint32_t> corner_of; ///< [3T]
};

/// Attribute tables in the new order: element i gets the value that its old place had.
Appearance reordered(const Appearance& appearance, const NewOrder& order);

/// Positions of one frame: vertex i of the result [V x 3] is where vertex_of[i] is; several may be at one.
void reorder_frame(std::span<const float> frame, std::span<const std::uint32_t> vertex_of, std::span<float> result);

} // namespace meshreel
