/// Counted, refused, or passed on to the kernel.
// SPDX-License-Identifier: MIT
#include "tests/machine/calls.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace meshreel::machine {

namespace {

struct Plan {
    bool on = false, happened = false;
    Call call = Call::write;
    std::size_t number = Fault::none;
    int error = 0;
    How how = How::refused;
    std::array<std::size_t, calls.size()> seen{};
};
Plan plan;

/// Whether this call of the tested code is the one.
bool is_due(Call call)
{
    if (!plan.on) return false;
    const std::size_t number = plan.seen[static_cast<std::size_t>(call)]++;
    if (call != plan.call || number != plan.number) return false;
    plan.happened = true;
    return true;
}

int fail(int error)
{
    errno = error;
    return -1;
}

ssize_t write_some(int file, const void* bytes, std::size_t count)
{
    const bool due = is_due(Call::write);
    if (plan.on && plan.how == How::in_pieces) count = std::min<std::size_t>(count, 7);
    if (due && plan.how == How::short_first) {
        ++plan.number; // the next one
        plan.how = How::refused;
        count = (count + 1) / 2;
    } else if (due && plan.how != How::in_pieces) {
        return fail(plan.error);
    }
    return ::syscall(SYS_write, file, bytes, count);
}

} // namespace

Fault::Fault(Call call, std::size_t number, int error, How how)
{
    plan = {true, false, call, number, error, how, {}};
}
Fault::~Fault()
{
    plan.on = false;
}
bool Fault::happened() const
{
    return plan.happened;
}

Count::Count()
{
    plan = {};
    plan.on = true;
}
Count::~Count()
{
    plan.on = false;
}
std::size_t Count::of(Call call) const
{
    return plan.seen[static_cast<std::size_t>(call)];
}

} // namespace meshreel::machine

using meshreel::machine::Call;

extern "C" {

int open(const char* path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    const int mode = (flags & O_CREAT) != 0 ? va_arg(more, int) : 0;
    va_end(more);
    const bool writes = (flags & O_ACCMODE) != O_RDONLY;
    if (writes && meshreel::machine::is_due(Call::open)) return meshreel::machine::fail(meshreel::machine::plan.error);
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

ssize_t write(int file, const void* bytes, std::size_t count)
{
    return meshreel::machine::write_some(file, bytes, count);
}

int fsync(int file)
{
    if (meshreel::machine::is_due(Call::fsync)) return meshreel::machine::fail(meshreel::machine::plan.error);
    return static_cast<int>(::syscall(SYS_fsync, file));
}

int close(int file) // a descriptor is gone even where this fails
{
    const bool due = meshreel::machine::is_due(Call::close);
    const int closed = static_cast<int>(::syscall(SYS_close, file));
    return due ? meshreel::machine::fail(meshreel::machine::plan.error) : closed;
}

int rename(const char* from, const char* to) noexcept
{
    if (meshreel::machine::is_due(Call::rename)) return meshreel::machine::fail(meshreel::machine::plan.error);
    return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int link(const char* from, const char* to) noexcept
{
    if (meshreel::machine::is_due(Call::link)) return meshreel::machine::fail(meshreel::machine::plan.error);
    return static_cast<int>(::syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}
}
