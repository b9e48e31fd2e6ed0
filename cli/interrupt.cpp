/// One thread waits for signals, so that the cleaning may do what a signal handler may not.
// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <csignal>
#include <cstdlib>
#include <dirent.h>
#include <filesystem>
#include <mutex>
#include <pthread.h>
#include <string_view>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace meshreel::cli {

namespace {

/// Open folders that may hold temporary files. Never destroyed: the waiting thread outlives main.
struct Folders {
    std::mutex lock;
    std::vector<DIR*> open;
};

Folders& folders()
{
    static auto* const all = new Folders;
    return *all;
}

/// "name.PID-NUMBER.tmp", as AtomicFile calls them.
bool is_ours(std::string_view name)
{
    const std::string mark = "." + std::to_string(::getpid()) + "-";
    constexpr std::string_view ending = ".tmp";
    return name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending &&
           name.find(mark) != std::string_view::npos;
}

void remove_temporaries()
{
    const std::lock_guard guard(folders().lock);
    const struct rlimit nothing {
        0, 0
    };
    ::setrlimit(RLIMIT_NOFILE, &nothing); // no other thread can open a new file behind our back
    for (DIR* folder : folders().open) {
        ::rewinddir(folder);
        while (const dirent* entry = ::readdir(folder))
            if (is_ours(entry->d_name)) ::unlinkat(::dirfd(folder), entry->d_name, 0);
    }
}

[[noreturn]] void wait_for_signal(sigset_t signals)
{
    int signal = 0;
    while (::sigwait(&signals, &signal) != 0) {
    }
    ::close(STDERR_FILENO); // the others' complaints about files they can no longer open mean nothing
    remove_temporaries();
    std::signal(signal, SIG_DFL);
    ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    ::kill(::getpid(), signal); // ends as if never caught: the shell must know
    std::_Exit(128 + signal);
}

bool ignored(int signal)
{
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

} // namespace

void watch_for_interrupts()
{
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!ignored(signal)) ::sigaddset(&signals, signal); // nohup, or a shell's background
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(wait_for_signal, signals).detach();
}

void expect_output_beside(const std::string& path)
{
    if (path == "-") return;
    const std::string parent = std::filesystem::path(path).parent_path().string();
    DIR* const folder = ::opendir(parent.empty() ? "." : parent.c_str());
    if (folder == nullptr) return; // whoever writes there will say why it cannot
    const std::lock_guard guard(folders().lock);
    folders().open.push_back(folder);
}

} // namespace meshreel::cli
