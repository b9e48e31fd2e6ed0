/// Smoothing of every frame: detail goes, the coarse shape stays.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/distort/distortion.h"

namespace meshreel::distort {

/// Each of request.amount times every vertex moves half way to the plain mean of its neighbours along edges. Vertices without a triangle stay;
/// borders shrink like everything. The same bytes on every machine.
/// @cost O(F T) each time.
Result<Animation> laplacian_smoothing(const Animation& animation, const Request& request);

/// Each time such a step of 0.5 is followed by one of -0.53: what is smooth keeps its size.
/// @source G. Taubin, A signal processing approach to fair surface design, 1995
Result<Animation> taubin_smoothing(const Animation& animation, const Request& request);

} // namespace meshreel::distort
