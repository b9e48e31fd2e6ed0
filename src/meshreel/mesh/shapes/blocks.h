/// Closed surfaces of bodies built from blocks, at any resolution.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "meshreel/mesh/shapes/body.h"

namespace meshreel::shapes {

/// Boxes between planes. A block (i, j, k) fills the i-th gap between planes along x, the j-th along y, the k-th along z.
struct Blocks {
    std::array<std::vector<double>, 3> planes;        ///< rising, for x, y and z
    std::vector<std::array<std::uint32_t, 3>> filled; ///< no two may touch by an edge or corner alone
};

/// The surface of the blocks, in nearly square cells, with exactly `vertices` vertices; triangles run anticlockwise seen
/// from outside. Needs at least the vertices of the blocks themselves.
Body block_surface(const Blocks& blocks, std::uint32_t vertices);

} // namespace meshreel::shapes
