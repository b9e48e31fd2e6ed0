/// Temporary files first, names at the end.
// SPDX-License-Identifier: MIT
#include "meshreel/io/file_set.h"

namespace meshreel::io {

Status FileSet::add(const std::string& path, ByteView bytes)
{
    if (!taken_.insert(path).second) return Error{ErrorCode::usage, "two files would have this name", {}, path, {}};
    MESHREEL_TRY(AtomicFile file, AtomicFile::create(path, overwrite_));
    MESHREEL_CHECK(file.write(bytes));
    MESHREEL_CHECK(file.finish());
    files_.push_back(std::move(file));
    return Ok{};
}

Status FileSet::commit()
{
    for (std::size_t i = 0; i < files_.size(); ++i) {
        Status status = files_[i].commit_revertibly();
        if (status.ok()) continue;
        for (std::size_t done = 0; done < i; ++done) files_[done].revert();
        return status;
    }
    return Ok{};
}

} // namespace meshreel::io
