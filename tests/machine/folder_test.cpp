/// Folders that may not be written, and disks that are full.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meshreel/io/io.h"
#include "meshreel/meshreel.h"
#include "tests/machine/folder.h"

using namespace meshreel;
using namespace meshreel::machine;

namespace {

constexpr int good = 0, cannot_try = 77;

/// What a body returns, run in a process of its own.
template <class Body>
int in_a_child(const Body& body)
{
    const pid_t child = ::fork();
    if (child == 0) ::_exit(body());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::size_t files_in(const std::string& folder)
{
    const std::filesystem::directory_iterator all(folder);
    return static_cast<std::size_t>(std::distance(all, std::filesystem::directory_iterator()));
}

class Machine : public FolderTest {};

} // namespace

TEST_F(Machine, AReadOnlyFolderIsAnError)
{
    ASSERT_TRUE(write_file(path("old"), Bytes{1, 2, 3}, false).ok());
    ASSERT_EQ(::chmod(folder_.c_str(), 0555), 0);
    const int outcome = in_a_child([&] {
        if (::geteuid() == 0 && ::setresuid(65534, 65534, 65534) != 0) return cannot_try;
        const Status written = write_file(path("new"), Bytes(10), false),
                     over = write_file(path("old"), Bytes(10), true);
        const bool clear = !written.ok() && !over.ok() && written.error().code == ErrorCode::io &&
                           over.error().code == ErrorCode::io &&
                           over.error().sentence().find("Permission denied") != std::string::npos;
        return clear && files_in(folder_) == 1 ? good : 1;
    });
    ASSERT_EQ(::chmod(folder_.c_str(), 0755), 0);
    if (outcome == cannot_try) GTEST_SKIP() << "cannot become a user without rights";
    EXPECT_EQ(outcome, good);
    EXPECT_EQ(*read_file(path("old")), (Bytes{1, 2, 3}));
}

TEST_F(Machine, ADiskThatBecomesFullIsAnError)
{
    const int outcome = in_a_child([&] {
        if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
            return cannot_try;
        if (::mount("none", folder_.c_str(), "tmpfs", 0, "size=64k") != 0) return cannot_try;
        if (!write_file(path("old"), Bytes{1, 2, 3}, false).ok()) return 1;
        io::SaveOptions options;
        options.overwrite = true;
        for (const char* name : {"a.pc2", "a.mdd", "a.glb", "a.###.obj", "a.###.ply"}) {
            const Status saved = io::save(small_animation(3000), path(name), options);
            if (saved.ok() || saved.error().code != ErrorCode::io) return 2;
            if (saved.error().sentence().find("No space left") == std::string::npos) return 3;
            if (files_in(folder_) != 1) return 4;
        }
        if (write_file(path("old"), Bytes(1 << 20), true).ok()) return 5;
        return read_file(path("old"))->size() == 3 && files_in(folder_) == 1 ? good : 6;
    });
    if (outcome == cannot_try) GTEST_SKIP() << "cannot mount a small disk";
    EXPECT_EQ(outcome, good);
}

TEST_F(Machine, AFullDeviceIsAnError)
{
    EXPECT_EQ(write_file("/dev/full", Bytes(1), true).error().code, ErrorCode::io);
    io::SaveOptions options;
    options.overwrite = true;
    const io::Format* const pc2 = *io::format_of("a.pc2");
    EXPECT_EQ(pc2->save(small_animation(3), "/dev/full", options).error().code, ErrorCode::io);
}
