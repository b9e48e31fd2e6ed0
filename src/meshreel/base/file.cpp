/// Files by POSIX calls, each failure with the system's reason.
// SPDX-License-Identifier: MIT
#include "meshreel/base/file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <random>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "meshreel/base/text.h"

namespace meshreel {

namespace {

Error system_error(const std::string& path, const char* what)
{
    return {ErrorCode::io, concat(what, ": ", std::strerror(errno)), {}, path, {}};
}

struct Descriptor {
    int number;
    ~Descriptor()
    {
        if (number > 2) ::close(number);
    }
};

/// The bytes offset .. offset + count - 1 of an open file.
Result<Bytes> bytes_at(int descriptor, std::uint64_t offset, std::size_t count, const std::string& path)
{
    Bytes bytes(count);
    for (std::size_t filled = 0; filled < count;) {
        const ssize_t got =
            ::pread(descriptor, bytes.data() + filled, count - filled, static_cast<off_t>(offset + filled));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_error(path, "cannot read");
        if (got == 0) return Error{ErrorCode::io, "became shorter while it was read", {}, path, {}};
        filled += static_cast<std::size_t>(got);
    }
    return bytes;
}

/// A sibling name that nobody else uses; the randomness only avoids collisions.
std::string temporary_name(const std::string& path)
{
    return concat(path, ".", static_cast<unsigned>(::getpid()), "-", std::random_device{}(), ".tmp");
}

} // namespace

Result<Bytes> read_file(const std::string& path, const DecodeLimits& limits)
{
    const Descriptor file{path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) return system_error(path, "cannot open");
    struct stat status {};
    if (::fstat(file.number, &status) == 0 && S_ISDIR(status.st_mode))
        return Error{ErrorCode::io, "is a folder, not a file", {}, path, {}};
    Bytes bytes;
    bytes.reserve(S_ISREG(status.st_mode) && static_cast<std::uint64_t>(status.st_size) <= limits.max_memory
                      ? static_cast<std::size_t>(status.st_size) + 1
                      : 0);
    constexpr std::size_t piece_size = 1 << 20;
    for (;;) {
        const std::size_t filled = bytes.size();
        bytes.resize(filled + std::min(piece_size, std::max<std::size_t>(bytes.capacity() - filled, 4096)));
        const ssize_t got = ::read(file.number, bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) {
            bytes.resize(filled);
            continue;
        }
        if (got < 0) return system_error(path, "cannot read");
        bytes.resize(filled + static_cast<std::size_t>(got));
        if (got == 0) return bytes;
        if (bytes.size() > limits.max_memory)
            return in_file(
                Result<Bytes>(bad_input(concat("is larger than the memory limit of ", limits.max_memory, " bytes"))),
                path);
    }
}

bool is_regular_file(const std::string& path)
{
    struct stat status {};
    return path != "-" && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

FileSource::FileSource(std::string path, int descriptor, std::uint64_t size)
    : path_(std::move(path)), descriptor_(descriptor), size_(size)
{
}

FileSource::FileSource(FileSource&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_)
{
}

FileSource::~FileSource()
{
    if (descriptor_ >= 0) ::close(descriptor_);
}

Result<FileSource> FileSource::open(const std::string& path)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return system_error(path, "cannot open");
    FileSource file(path, descriptor, 0);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return system_error(path, "cannot read");
    if (!S_ISREG(status.st_mode)) return Error{ErrorCode::io, "is not a regular file", {}, path, {}};
    file.size_ = static_cast<std::uint64_t>(status.st_size);
    return file;
}

Result<Bytes> FileSource::fetch(std::uint64_t offset, std::size_t count)
{
    return bytes_at(descriptor_, offset, count, path_);
}

Result<Former> Former::keep(const std::string& path)
{
    Former former;
    struct stat status {};
    const bool there = path != "-" && ::stat(path.c_str(), &status) == 0;
    if (path == "-" || (there && !S_ISREG(status.st_mode))) return former;
    former.path_ = path;
    if (!there) return former;
    former.second_ = temporary_name(path);
    if (::link(path.c_str(), former.second_.c_str()) == 0) return former;
    former.second_.clear();
    if (errno == EPERM || errno == ENOENT) return former; // EPERM: a file system without links, which keeps nothing
    return system_error(path, "cannot keep what was there");
}

Former::Former(Former&& other) noexcept
    : path_(std::exchange(other.path_, {})), second_(std::exchange(other.second_, {}))
{
}

Former::~Former()
{
    if (!second_.empty()) ::unlink(second_.c_str());
}

void Former::bring_back()
{
    if (path_.empty()) return;
    if (second_.empty() || ::rename(second_.c_str(), path_.c_str()) != 0) ::unlink(path_.c_str());
    second_.clear();
    path_.clear();
}

AtomicFile::AtomicFile(std::string path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor)
{
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_), former_(std::move(other.former_))
{
}

AtomicFile::~AtomicFile()
{
    if (descriptor_ > 2) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<AtomicFile> AtomicFile::create(const std::string& path, bool overwrite)
{
    if (path == "-") return AtomicFile(path, {}, STDOUT_FILENO);
    struct stat status {};
    const bool there = ::stat(path.c_str(), &status) == 0;
    if (there && S_ISDIR(status.st_mode)) return Error{ErrorCode::io, "is a folder, not a file", {}, path, {}};
    if (there && !S_ISREG(status.st_mode)) { // a device or a pipe: written as it is, never replaced
        const int device = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (device < 0) return system_error(path, "cannot write");
        return AtomicFile(path, {}, device);
    }
    if (there && !overwrite) return Error{ErrorCode::usage, "exists already; pass -y to overwrite it", {}, path, {}};
    AtomicFile file(path, temporary_name(path), -1); // before there is a file that it would have to remove
    file.descriptor_ = ::open(file.temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.descriptor_ < 0) return system_error(path, "cannot write");
    return file;
}

Status AtomicFile::write(ByteView bytes)
{
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor_, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return system_error(path_, "cannot write");
        bytes = bytes.subspan(static_cast<std::size_t>(put));
        size_ += static_cast<std::uint64_t>(put);
    }
    return Ok{};
}

Result<Bytes> AtomicFile::fetch(std::uint64_t offset, std::size_t count)
{
    return bytes_at(descriptor_, offset, count, path_);
}

Status AtomicFile::finish()
{
    if (temporary_.empty() || descriptor_ < 0) return Ok{};
    if (::fsync(descriptor_) != 0 && errno != EINVAL) return system_error(path_, "cannot write");
    if (::close(std::exchange(descriptor_, -1)) != 0) return system_error(path_, "cannot write");
    return Ok{};
}

Status AtomicFile::commit()
{
    if (temporary_.empty()) return Ok{};
    MESHREEL_CHECK(finish());
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) return system_error(path_, "cannot rename into place");
    temporary_.clear();
    return Ok{};
}

Status AtomicFile::commit_revertibly()
{
    if (temporary_.empty()) return Ok{};
    MESHREEL_TRY(Former former, Former::keep(path_));
    MESHREEL_CHECK(commit());
    former_.emplace(std::move(former));
    return Ok{};
}

void AtomicFile::revert()
{
    if (former_) former_->bring_back();
    former_.reset();
}

Status write_file(const std::string& path, ByteView bytes, bool overwrite)
{
    MESHREEL_TRY(AtomicFile file, AtomicFile::create(path, overwrite));
    MESHREEL_CHECK(file.write(bytes));
    return file.commit();
}

} // namespace meshreel
