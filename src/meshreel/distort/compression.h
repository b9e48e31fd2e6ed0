/// What Coddyac leaves of an animation when it is asked for too little.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/distort/distortion.h"

namespace meshreel::distort {

/// request.amount: the quantisation step of the coefficients, model units; as many components as such a step is worth.
/// What decoding the file would give, bit for bit. The analysis is the encoder's, so machines may differ in a last bit.
/// @source thesis 7.4, 8.1
Result<Animation> coarse_quantisation(const Animation& animation, const Request& request);

/// request.amount: the number of eigentrajectories, 1 or more; their coefficients have a step of 10^-4 body diagonals. Else as above.
/// @fails usage: none.
/// @source thesis 7.4, 8.1
Result<Animation> few_bases(const Animation& animation, const Request& request);

} // namespace meshreel::distort
