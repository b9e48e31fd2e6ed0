/// Progress of long work, told to whoever asked.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace meshreel {

/// Called with the stage's name and the fraction done, [0, 1]. May be empty. Called from the calling thread only.
using Progress = std::function<void(std::string_view stage, double fraction)>;

inline void report(const Progress& progress, std::string_view stage, double fraction)
{
    if (progress) progress(stage, fraction);
}

} // namespace meshreel
