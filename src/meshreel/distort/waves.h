/// Smooth distortions: a wave in space, and one in time.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/distort/distortion.h"

namespace meshreel::distort {

/// A sin(omega x), of the vertex' first coordinate, added to all three. request.amount: A, model units; omega: radians a model unit,
/// by default ten waves along the body diagonal. The same bytes on every machine.
/// @fails usage: omega x is above a million.  @source thesis 7.4
Result<Animation> sine_in_space(const Animation& animation, const Request& request);

/// A sin(omega f), f from 0, added to all three coordinates of every vertex. omega: radians a frame, by default a wave every ten frames.
/// @fails usage: omega f is above a million.  @source thesis 7.4
Result<Animation> sine_in_time(const Animation& animation, const Request& request);

} // namespace meshreel::distort
