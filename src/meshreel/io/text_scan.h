/// Lines, words and numbers of a text file in memory, without copies.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "meshreel/base/views.h"

namespace meshreel::io {

/// Walks over lines that end in LF, CR LF or CR, and over the words of each.
class LineScanner {
public:
    /// How a line may end without ending.
    enum class Continuation : std::uint8_t { none, backslash };

    explicit LineScanner(ByteView text, Continuation continuation = Continuation::none);

    /// Goes to the next line, or to none.
    bool next_line();
    /// The next word of this line; empty at its end. A '#' at the beginning of a word ends the line.
    std::string_view word();
    /// What is left of this line, without the white space around it; of a continued line its present part. The line is
    /// over.
    std::string_view rest();
    /// The number of this line, from 1. A continued line has the number of its first part.
    std::uint64_t line() const { return line_; }
    /// The offset of what word() has not looked at yet.
    std::size_t offset() const { return at_; }
    /// The offset behind this line and its line end.
    std::size_t next_offset() const { return next_; }

private:
    bool continued(std::size_t line_end) const;
    void skip_space();

    std::string_view text_;
    bool backslash_;
    std::size_t at_ = 0;   ///< where the next word is searched
    std::size_t end_ = 0;  ///< of this line
    std::size_t next_ = 0; ///< beginning of the next line
    std::uint64_t line_ = 0;
    std::uint64_t lines_read_ = 0;
};

/// The float32 nearest to a decimal number. Nothing: the word is no number. Too large for a float32: an infinity.
std::optional<float> to_float(std::string_view word);
/// The double nearest to a decimal number, likewise.
std::optional<double> to_double(std::string_view word);
/// A whole number with an optional sign. Nothing: the word is none, or does not fit.
std::optional<std::int64_t> to_integer(std::string_view word);

/// A word from a file as it may stand in a message: short, and printable.
std::string in_quotes(std::string_view word);

} // namespace meshreel::io
