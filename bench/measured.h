/// Runs a piece of work in a process of its own and measures its time and its peak memory.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <optional>

namespace meshreel::bench {

/// What a child process found. The other figures are the work's own.
struct Measured {
    double seconds = 0.0;      ///< best of the repetitions
    double peak_bytes = 0.0;   ///< most resident memory while the work ran, everything included
    double before_bytes = 0.0; ///< resident memory just before the work
    std::array<double, 4> figures{};
};

/// prepare() makes the work; the work is timed `repetitions` times. Both run in a child process, so that the memory of
/// one measurement never counts for another. Nothing: the child failed, and has said why on standard error.
std::optional<Measured> measure_apart(const std::function<std::function<void(Measured&)>()>& prepare, int repetitions);

} // namespace meshreel::bench
