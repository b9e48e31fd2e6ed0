/// RBF based prediction on a decimated mesh (thesis 8.3.2).
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/codecs/codec.h"

namespace meshreel::codecs {

/// The registry's row.
Codec rbfp();

} // namespace meshreel::codecs
