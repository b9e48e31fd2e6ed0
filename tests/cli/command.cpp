/// fork, exec, and files for the streams: no pipe can fill up.
// SPDX-License-Identifier: MIT
#include "tests/cli/command.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace meshreel::cli_test {

namespace {

namespace fs = std::filesystem;

std::string slurp(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void spill(const fs::path& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

void limit(decltype(RLIMIT_AS) what, rlim_t most)
{
    const struct rlimit both {
        most, most
    };
    if (most != 0 && ::setrlimit(what, &both) != 0) ::_exit(126);
}

/// Between fork and exec: folder, streams and limits.
[[noreturn]] void become_the_command(const fs::path& folder, const fs::path& streams, std::vector<char*> texts,
                                     const Start& start)
{
    const auto stream = [&](const fs::path& path, int flags, int number) {
        if (::dup2(::open(path.c_str(), flags, 0600), number) < 0) ::_exit(126);
    };
    stream(streams / "in", O_RDONLY, STDIN_FILENO);
    stream(start.output_file.empty() ? streams / "out" : fs::path(start.output_file), O_WRONLY | O_CREAT,
           STDOUT_FILENO);
    stream(start.error_file.empty() ? streams / "err" : fs::path(start.error_file), O_WRONLY | O_CREAT, STDERR_FILENO);
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    limit(RLIMIT_FSIZE, start.largest_file);
    limit(RLIMIT_AS, start.largest_memory);
    ::execv(texts.front(), texts.data());
    ::_exit(127);
}

/// However busy the machine is: a child that has begun to write has long set up how it takes signals.
void wait_for_a_file(const fs::path& folder)
{
    constexpr int milliseconds_at_most = 60'000;
    for (int waited = 0; fs::is_empty(folder) && waited < milliseconds_at_most; ++waited) ::usleep(1000);
}

int wait_for(pid_t child)
{
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

Outcome run_in(const fs::path& folder, const std::vector<std::string>& arguments, const Start& start)
{
    std::string pattern = (fs::path(testing::TempDir()) / "meshreel-streams-XXXXXX").string();
    const fs::path streams = ::mkdtemp(pattern.data());
    spill(streams / "in", start.input);
    std::vector<std::string> words{MESHREEL_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> texts;
    for (std::string& word : words) texts.push_back(word.data());
    texts.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) become_the_command(folder, streams, texts, start);
    if (start.interrupt_at_first_file) {
        wait_for_a_file(folder);
        ::kill(child, SIGINT);
    }
    if (start.killed_after_us > 0) {
        ::usleep(start.killed_after_us);
        ::kill(child, SIGKILL);
    }
    Outcome outcome;
    outcome.exit_code = wait_for(child);
    outcome.out = slurp(streams / "out");
    outcome.err = slurp(streams / "err");
    fs::remove_all(streams);
    return outcome;
}

void CommandTest::SetUp()
{
    std::string pattern = (fs::path(testing::TempDir()) / "meshreel-test-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
}

void CommandTest::TearDown()
{
    fs::remove_all(folder_);
}

Outcome CommandTest::run(const std::string& words, const Start& start) const
{
    std::istringstream stream(words);
    return run_in(folder_, {std::istream_iterator<std::string>(stream), {}}, start);
}

Outcome CommandTest::good(const std::string& words, const Start& start) const
{
    Outcome outcome = run(words, start);
    EXPECT_EQ(outcome.exit_code, 0) << words << "\n" << outcome.err;
    return outcome;
}

std::string CommandTest::read(const std::string& name) const
{
    return slurp(folder_ / name);
}

void CommandTest::write(const std::string& name, const std::string& bytes) const
{
    spill(folder_ / name, bytes);
}

std::vector<std::string> CommandTest::files() const
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace meshreel::cli_test
