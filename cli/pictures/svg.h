/// Words and pictures on their way into SVG and HTML.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "meshreel/base/views.h"

namespace meshreel::cli {

/// Text that may stand between tags or in an attribute: & < > " become entities, signs that XML forbids spaces.
std::string escaped(std::string_view text);

/// Bytes in base 64, as in a data: URL.
std::string base64(ByteView bytes);

} // namespace meshreel::cli
