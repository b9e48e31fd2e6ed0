/// How much memory a test program holds: every operator new and delete of it is counted.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace meshreel::faults {

/// Bytes held now, and the most that were held since the last call of reset_peak().
std::size_t held();
std::size_t peak();
void reset_peak();

} // namespace meshreel::faults
