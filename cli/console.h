/// Standard error for people: remarks, warnings, and a progress bar on a terminal.
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <string_view>

#include "meshreel/base/progress.h"

namespace meshreel::cli {

/// How much a command says. Errors are always said.
class Console {
public:
    bool quiet = false;   ///< -q: errors only
    bool verbose = false; ///< -v: details too
    bool json = false;    ///< --json: figures on standard output instead of text

    Console();

    /// Always.
    void error(std::string_view sentence);
    /// Unless quiet.
    void warn(std::string_view sentence);
    /// Unless quiet or json.
    void say(std::string_view text);
    /// Only when verbose.
    void detail(std::string_view sentence);

    /// Draws a bar where standard error is a terminal and neither quiet nor json was asked for; else does nothing.
    /// Must not outlive the console.
    Progress progress();
    void clear_bar();

private:
    void draw(std::string_view stage, double fraction);

    bool terminal_;
    bool bar_drawn_ = false;
    std::chrono::steady_clock::time_point last_drawn_{};
};

/// Seconds since it was made; and those that processors have worked since for this process, all its threads together.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    double processor_seconds() const
    {
        return static_cast<double>(std::clock() - worked_) / static_cast<double>(CLOCKS_PER_SEC);
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::clock_t worked_ = std::clock();
};

/// The most memory this process has held so far, bytes.
unsigned long long peak_memory_bytes();

} // namespace meshreel::cli
