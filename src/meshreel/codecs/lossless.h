/// The codec lossless: another codec's frames as a guess, and every float32 coded by how far from the guess it is.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/codecs/codec.h"

namespace meshreel::codecs {

/// @source lossless.md
Codec lossless();

} // namespace meshreel::codecs
