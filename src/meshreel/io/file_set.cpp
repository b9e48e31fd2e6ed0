/// Temporary files first, names at the end.
// SPDX-License-Identifier: MIT
#include "meshreel/io/file_set.h"

#include <cstdio>

namespace meshreel::io {

Status FileSet::add(const std::string& path, ByteView bytes)
{
    if (!taken_.insert(path).second) return Error{ErrorCode::usage, "two files would have this name", {}, path, {}};
    MESHREEL_TRY(AtomicFile file, AtomicFile::create(path, overwrite_));
    MESHREEL_CHECK(file.write(bytes));
    MESHREEL_CHECK(file.finish());
    paths_.push_back(path);
    files_.push_back(std::move(file));
    return Ok{};
}

Status FileSet::commit()
{
    for (std::size_t i = 0; i < files_.size(); ++i) {
        Status status = files_[i].commit();
        if (status.ok()) continue;
        for (std::size_t done = 0; done < i; ++done) std::remove(paths_[done].c_str());
        return status;
    }
    return Ok{};
}

} // namespace meshreel::io
