/// The version of the library; the same as in CMakeLists.txt, which a test checks.
// SPDX-License-Identifier: MIT
#pragma once

namespace meshreel {

inline constexpr const char* version = "0.1.0";

} // namespace meshreel
