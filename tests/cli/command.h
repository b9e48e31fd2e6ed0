/// Runs the real command as a child process and keeps what it said.
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meshreel::cli_test {

/// What a finished command left: its exit code (128 + signal where a signal ended it) and its two streams.
struct Outcome {
    int exit_code = -1;
    std::string out, err;

    /// Standard output as JSON; a discarded value where it is none.
    nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// How the child is started.
struct Start {
    std::string input = {};                ///< bytes on standard input
    std::string output_file = {};          ///< standard output goes there instead of into Outcome::out
    std::string error_file = {};           ///< standard error goes there instead of into Outcome::err
    unsigned long long largest_file = 0;   ///< bytes that a file may have; 0: any
    unsigned long long largest_memory = 0; ///< bytes of address space; 0: any
    unsigned killed_after_us = 0;          ///< SIGKILL so many microseconds after its start; 0: never
    bool interrupt_at_first_file = false;  ///< SIGINT as soon as there is anything in the folder
};

/// Runs `meshreel ARGUMENTS` in a folder.
Outcome run_in(const std::filesystem::path& folder, const std::vector<std::string>& arguments, const Start& start = {});

/// A test with an empty folder of its own, in which commands run.
class CommandTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// run("convert a.obj b.pc2"): words are parted by spaces.
    Outcome run(const std::string& words, const Start& start = {}) const;
    /// Runs, and expects exit code 0.
    Outcome good(const std::string& words, const Start& start = {}) const;

    std::string read(const std::string& name) const;
    void write(const std::string& name, const std::string& bytes) const;
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    /// Names of all files in the folder, sorted.
    std::vector<std::string> files() const;

    std::filesystem::path folder_;
};

} // namespace meshreel::cli_test
