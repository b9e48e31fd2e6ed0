/// The parts of the page of a heat map, compiled in.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace meshreel::cli {

extern const std::string_view page_body;   ///< page.html
extern const std::string_view page_style;  ///< page.css
extern const std::string_view page_script; ///< page.js

} // namespace meshreel::cli
