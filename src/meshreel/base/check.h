/// Broken preconditions: Misuse at the front door, an assert inside.
// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <stdexcept>

namespace meshreel {

/// A caller broke a stated precondition of a public function; what() names it.
struct Misuse : std::logic_error {
    using std::logic_error::logic_error;
};

inline void require(bool condition, const char* precondition)
{
    if (!condition) throw Misuse(precondition);
}

} // namespace meshreel
