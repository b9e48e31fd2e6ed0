/// reel, the default codec: PCA of trajectories, vertices from coarse to fine by kriging, poses likewise.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/codecs/codec.h"

namespace meshreel::codecs {

/// The registry's row. The idea, the payload and the equations: reel.md.
Codec reel();

} // namespace meshreel::codecs
