/// An interrupted command leaves no temporary file behind.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace meshreel::cli {

/// From now on SIGINT, SIGTERM and SIGHUP remove this process's temporary files before they end it; a broken pipe and
/// a file-size limit become write errors. Call once, before any thread is made.
void watch_for_interrupts();

/// Temporary files of this process will stand beside `path` (base/file.h, AtomicFile).
void expect_output_beside(const std::string& path);

} // namespace meshreel::cli
