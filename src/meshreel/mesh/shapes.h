/// Generated animations: the data of the demo and of the tests.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "meshreel/base/result.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::shapes {

struct ShapeOptions {
    std::uint32_t vertices = 2500; ///< V of the result, exactly; at least the shape's minimum
    std::uint32_t frames = 100;    ///< F of the result, exactly; >= 1
    double fps = 25.0;      ///< frames a second, 1 .. 10000; motion is in seconds, so more frames show more of it
    std::uint64_t seed = 1; ///< another seed, another motion
};

/// One row of the registry.
struct Shape {
    std::string_view name;    ///< "cloth", as in `meshreel generate cloth`
    std::string_view summary; ///< one line
    std::uint32_t minimum_vertices;
    Animation (*make)(const ShapeOptions& options); ///< options already checked
};

/// Every shape, in the order of the documentation.
std::span<const Shape> all();

/// The shape of that name, or null.
const Shape* find(std::string_view name);

/// Makes an animation: V and F exactly as asked, valid, and the same bytes for the same options on every machine and
/// with every compiler: only + - * / sqrt and base/exact.h, in a fixed order.
/// @fails usage: too few vertices for this shape, no frame, fps out of its range, or more than 2^31 numbers.
Result<Animation> generate(const Shape& shape, const ShapeOptions& options = {});

} // namespace meshreel::shapes
