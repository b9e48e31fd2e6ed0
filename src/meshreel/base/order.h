/// What becomes of the numbering of vertices and triangles in a file.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace meshreel {

/// Whether the decoded vertices and triangles stand in the original order. The values are those of the format.
enum class Order : std::uint8_t {
    keep, ///< vertices, triangles and each triangle's first corner come back as they were (default)
    free, ///< numbered as the traversal meets them; orientation and multiplicity are kept
    base  ///< as in a base mesh that the reader has too: no connectivity and no order in the file
};

} // namespace meshreel
