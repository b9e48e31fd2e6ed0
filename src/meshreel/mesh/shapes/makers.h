/// The generators behind the registry of shapes. Each takes checked options.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/mesh/shapes.h"

namespace meshreel::shapes {

Animation wave(const ShapeOptions& options);

} // namespace meshreel::shapes
