/// Linear least squares; encoder side.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "meshreel/base/views.h"

namespace meshreel::linalg {

/// The x [n] with the least |A x - b|, the shortest where several have it. A [m x n], b [m], m >= 1.
/// @cost O(m n^2).
std::vector<double> least_squares(MatrixView<const double> A, std::span<const double> b);

} // namespace meshreel::linalg
