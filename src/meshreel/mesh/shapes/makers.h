/// The generators behind the registry of shapes. Each takes checked options.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/mesh/shapes.h"

namespace meshreel::shapes {

Animation cloth(const ShapeOptions& options);
Animation jelly(const ShapeOptions& options);
Animation swimmer(const ShapeOptions& options);
Animation snake(const ShapeOptions& options);
Animation walker(const ShapeOptions& options);
Animation wave(const ShapeOptions& options);

} // namespace meshreel::shapes
