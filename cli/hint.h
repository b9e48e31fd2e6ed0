/// "Did you mean ...?"
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace meshreel::cli {

/// The candidate nearest to what was written, or nothing where none is near (a third of its letters, at most 3).
std::string nearest(std::string_view written, std::span<const std::string> candidates);

} // namespace meshreel::cli
