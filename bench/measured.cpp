/// fork, clear the high-water mark, run, and send the figures home through a pipe.
// SPDX-License-Identifier: MIT
#include "bench/measured.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace meshreel::bench {

namespace {

/// A line of /proc/self/status such as "VmHWM:  1234 kB", in bytes.
double status_bytes(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == name + ":") {
            double kilobytes = 0.0;
            status >> kilobytes;
            return 1024.0 * kilobytes;
        }
    return 0.0;
}

/// From now on VmHWM counts afresh.
void forget_peak()
{
    std::ofstream("/proc/self/clear_refs") << 5;
}

Measured run(const std::function<std::function<void(Measured&)>()>& prepare, int repetitions)
{
    using Clock = std::chrono::steady_clock;
    const std::function<void(Measured&)> work = prepare();
    Measured measured;
    measured.seconds = std::numeric_limits<double>::infinity();
    forget_peak();
    measured.before_bytes = status_bytes("VmRSS");
    for (int i = 0; i < repetitions; ++i) {
        const Clock::time_point start = Clock::now();
        work(measured);
        measured.seconds = std::min(measured.seconds, std::chrono::duration<double>(Clock::now() - start).count());
    }
    measured.peak_bytes = status_bytes("VmHWM");
    return measured;
}

[[noreturn]] void be_the_child(const std::function<std::function<void(Measured&)>()>& prepare, int repetitions,
                               int pipe)
{
    try {
        const Measured measured = run(prepare, repetitions);
        _exit(write(pipe, &measured, sizeof measured) == sizeof measured ? 0 : 1);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    _exit(1);
}

} // namespace

std::optional<Measured> measure_apart(const std::function<std::function<void(Measured&)>()>& prepare, int repetitions)
{
    int ends[2];
    if (pipe(ends) != 0) return std::nullopt;
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) be_the_child(prepare, repetitions, ends[1]);
    close(ends[1]);
    Measured measured;
    const bool whole = child > 0 && read(ends[0], &measured, sizeof measured) == sizeof measured;
    close(ends[0]);
    int status = 0;
    if (child > 0) waitpid(child, &status, 0);
    return whole && status == 0 ? std::optional(measured) : std::nullopt;
}

} // namespace meshreel::bench
