/// From coefficients and a basis to frames: what every PCA codec's decoder ends with.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/basis.h"

namespace meshreel::codecs {

/// t = m + sum_k c_k B_k for every vertex, k rising, in double, rounded once to float32: the same on every machine.
/// C [W x K]; frames [F x 3W].
/// @cost O(W F K).  @source thesis (8.2)
void rebuild(const Basis& basis, MatrixView<const double> C, MatrixView<float> frames, Threads threads);

} // namespace meshreel::codecs
