/// Files in and out: reads whole ones with a cap, or parts; writes to a temporary name and renames.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "meshreel/base/byte_source.h"
#include "meshreel/base/limits.h"
#include "meshreel/base/result.h"
#include "meshreel/base/spool.h"
#include "meshreel/base/views.h"

namespace meshreel {

/// All bytes of a file; "-" is standard input. @fails io: cannot be opened or read; bad_input: larger than the limit.
Result<Bytes> read_file(const std::string& path, const DecodeLimits& limits = {});

/// A regular file, read where it is asked to.
class FileSource : public ByteSource {
public:
    /// @fails io: it cannot be opened, or is not a regular file.
    static Result<FileSource> open(const std::string& path);

    FileSource(FileSource&& other) noexcept;
    FileSource& operator=(FileSource&&) = delete;
    ~FileSource() override;

    std::uint64_t size() const override { return size_; }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override;

private:
    FileSource(std::string path, int descriptor, std::uint64_t size);

    std::string path_;
    int descriptor_;
    std::uint64_t size_;
};

/// Whether a path names a regular file: one that FileSource opens.
bool is_regular_file(const std::string& path);

/// What has a name now, or that nothing has it, remembered for as long as this lives. A file stays under a second name, where
/// the file system can do that; devices and pipes are left alone.
class Former {
public:
    /// @fails io: it cannot be kept.
    static Result<Former> keep(const std::string& path);

    Former(Former&& other) noexcept;
    Former& operator=(Former&&) = delete;
    ~Former();

    /// The name means again what it meant; a file that has it by now is gone.
    void bring_back();

private:
    Former() = default;

    std::string path_;   ///< empty: there is nothing to bring back
    std::string second_; ///< name of what had the first; empty: nothing had it, or it is not kept
};

/// A file that appears under its name only when complete. Until commit() the bytes stand in a temporary file beside it,
/// which the destructor removes. "-" is standard output; a device or a pipe is written straight.
class AtomicFile : public Spool {
public:
    /// @fails io: the folder cannot be written, or `path` is one; usage: the file exists and `overwrite` is false.
    static Result<AtomicFile> create(const std::string& path, bool overwrite);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile() override;

    /// Appends. @fails io: the disk is full, or the file went away.
    Status write(ByteView bytes) override;
    /// Of all that was written.
    std::uint64_t size() const override { return size_; }
    /// @pre reads_back(), and finish() was not called.
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override;
    /// Whether fetch() can give what was written: standard output, devices and pipes cannot.
    bool reads_back() const { return !temporary_.empty(); }

    /// All bytes are written: puts them on disk and frees the descriptor, so that thousands of files can wait for commit().
    Status finish();
    /// Makes the file appear under its name, with all its bytes on disk. What had this name before is gone.
    Status commit();
    /// The same, but revert() can bring back what was there, as long as this lives.
    Status commit_revertibly();
    /// After commit_revertibly(): as if it had not been.
    void revert();

private:
    AtomicFile(std::string path, std::string temporary, int descriptor);

    std::string path_;
    std::string temporary_; ///< empty once committed, and for standard output
    int descriptor_;
    std::uint64_t size_ = 0;
    std::optional<Former> former_; ///< since commit_revertibly()
};

/// Writes a whole file at once, by AtomicFile.
Status write_file(const std::string& path, ByteView bytes, bool overwrite);

} // namespace meshreel
