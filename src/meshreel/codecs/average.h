/// Neighbourhood average on a decimated mesh (thesis 8.2).
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/codecs/codec.h"

namespace meshreel::codecs {

/// The registry's row.
Codec average();

} // namespace meshreel::codecs
