/// Gaussian noise: in every vertex and frame, in every vertex, in every frame.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/distort/distortion.h"

namespace meshreel::distort {

/// request.amount: the deviation of each coordinate, model units. Vertices with equal trajectories, as seams have
/// them, move together. The same bytes for the same seed on every machine.
/// @source thesis 7.4
Result<Animation> noise_in_vertex_and_frame(const Animation& animation, const Request& request);
Result<Animation> noise_in_vertex(const Animation& animation, const Request& request);
Result<Animation> noise_in_frame(const Animation& animation, const Request& request);

} // namespace meshreel::distort
