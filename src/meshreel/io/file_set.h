/// Several files that appear together or not at all.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "meshreel/base/file.h"

namespace meshreel::io {

/// Files are written under temporary names; commit() renames them all. Where anything fails nothing is left behind.
class FileSet {
public:
    explicit FileSet(bool overwrite) : overwrite_(overwrite) {}

    /// Writes one file, whole, under a temporary name. @fails io, usage: as AtomicFile; usage: the path was added before.
    Status add(const std::string& path, ByteView bytes);
    /// Makes all files appear. @fails io: a name cannot be taken; what was there before is there again.
    Status commit();

private:
    bool overwrite_;
    std::unordered_set<std::string> taken_;
    std::vector<AtomicFile> files_;
};

} // namespace meshreel::io
