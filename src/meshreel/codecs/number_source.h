/// Finds out what made the numbers of a sequence: a text of few digits, integers in some unit, or float arithmetic.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/coding/number_line.h"

namespace meshreel::codecs {

/// The line that the values of each coordinate lie on, at the fewest bits: that of all float32 where no coarser one fits.
/// Decimals are found whatever they were multiplied with, and even spacings wherever they begin. For encoders only.
/// frames [F x 3W].  @cost O(F W), and a few Fourier transforms of 2^20 values.
std::array<coding::NumberLine, 3> number_lines(MatrixView<const float> frames, Threads threads);

} // namespace meshreel::codecs
