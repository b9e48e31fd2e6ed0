/// A mesh with the errors as its colours, in three kinds of file.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "cli/pictures/surfaces.h"
#include "meshreel/base/result.h"

namespace meshreel::cli {

/// How a heat map is made.
struct HeatMapOptions {
    HeatOf of;                             ///< which error of a vertex, where the file has but one (ply, glb)
    std::uint64_t page_bytes = 32u << 20;  ///< that a page may have; frames are left out until it has
    std::string original, distorted;       ///< their names, for captions
    bool ascii = false;                    ///< ply as text
    std::function<void(std::string)> warn; ///< told what was left out
};

/// One frame with red, green, blue of each vertex and its error as the property "quality". The frame is the one asked
/// for, else the first.
Result<Bytes> heat_ply(const Surfaces& surfaces, const HeatMapOptions& options);

/// The animation with one colour a vertex (COLOR_0), its error (_ERROR), and a colour bar beside it; the range and the
/// measure are said in the scene's extras. Without triangles: points. @fails unsupported: more than 4 GB.
Result<Bytes> heat_glb(const Surfaces& surfaces, const HeatMapOptions& options);

/// A page that plays the animation with the errors of every frame; it needs nothing but itself. Positions have 16 bits
/// a coordinate and errors 8 bits. @pre the heat keeps every frame.
Result<Bytes> heat_page(const Surfaces& surfaces, const HeatMapOptions& options);

} // namespace meshreel::cli
