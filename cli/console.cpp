/// Writes remarks and the progress bar, which never share a line.
// SPDX-License-Identifier: MIT
#include "cli/console.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

namespace meshreel::cli {

namespace {

/// What cannot be said is lost; the exit code still tells. (fmt::print would throw.)
void put(std::string_view text)
{
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

} // namespace

Console::Console() : terminal_(::isatty(STDERR_FILENO) != 0) {}

void Console::error(std::string_view sentence)
{
    clear_bar();
    put(fmt::format("meshreel: {}\n", sentence));
}

void Console::warn(std::string_view sentence)
{
    if (quiet) return;
    clear_bar();
    put(fmt::format("meshreel: warning: {}\n", sentence));
}

void Console::say(std::string_view text)
{
    if (quiet || json) return;
    clear_bar();
    put(text);
}

void Console::detail(std::string_view sentence)
{
    if (!verbose) return;
    clear_bar();
    put(fmt::format("meshreel: {}\n", sentence));
}

Progress Console::progress()
{
    if (!terminal_ || quiet || json) return {};
    return [this](std::string_view stage, double fraction) { draw(stage, fraction); };
}

void Console::draw(std::string_view stage, double fraction)
{
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (bar_drawn_ && now - last_drawn_ < 50ms) return;
    constexpr int width = 30;
    const double done = std::clamp(std::isnan(fraction) ? 0.0 : fraction, 0.0, 1.0);
    const int filled = static_cast<int>(done * width);
    put(fmt::format("\r\x1b[K[{:=<{}}{:<{}}] {:3.0f} %  {}", "", filled, "", width - filled, 100.0 * done, stage));
    std::fflush(stderr);
    bar_drawn_ = true;
    last_drawn_ = now;
}

void Console::clear_bar()
{
    if (!bar_drawn_) return;
    put("\r\x1b[K");
    bar_drawn_ = false;
}

unsigned long long peak_memory_bytes()
{
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<unsigned long long>(usage.ru_maxrss) * 1024;
}

} // namespace meshreel::cli
