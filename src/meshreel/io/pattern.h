/// Names of sequences: "walk.####.obj", "walk.%04d.obj", "walk.*.obj".
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshreel/base/result.h"

namespace meshreel::io {

/// A path whose file name stands for many. A run of n '#' and "%0nd" stand for a number of at least n digits, filled up
/// with zeros; '#' and "%d" for a number of any digits; '*' for any text and '?' for one byte. Folders are literal.
struct Pattern {
    std::string folder;                ///< with its '/', or empty
    std::string name;                  ///< the file name; without the number where `digits` is set
    std::size_t hole = 0;              ///< where in `name` the number belongs
    std::optional<std::size_t> digits; ///< at least so many; nothing: a glob

    /// The path of the frame with this number. `digits` must be set.
    std::string path(std::uint64_t number) const;
};

/// The pattern that a path is, or nothing: a plain path. @fails usage: two numbers in one name.
Result<std::optional<Pattern>> parse_pattern(const std::string& path);

/// One file of a sequence.
struct FrameFile {
    std::string path;
    std::uint64_t number = 0; ///< as in its name; its place for a glob
};

/// The files of a pattern: by their numbers, or for a glob in natural order ("walk2" before "walk10").
/// @fails io: no folder, no such file; bad_input: two files have the same number.
Result<std::vector<FrameFile>> list_files(const Pattern& pattern);

/// Whether a comes before b, digits compared as numbers.
bool natural_less(std::string_view a, std::string_view b);

/// Whether a name fits a pattern of '*', '?' and literal bytes. @cost O(|name| |pattern|)
bool glob_matches(std::string_view pattern, std::string_view name);

} // namespace meshreel::io
