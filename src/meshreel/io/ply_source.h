/// The numbers behind the header of a PLY file, as text or binary, one after the other.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "meshreel/io/ply_header.h"
#include "meshreel/io/text_scan.h"

namespace meshreel::io {

/// Gives numbers as doubles, which hold each of the types exactly.
class PlySource {
public:
    PlySource(ByteView bytes, const PlyHeader& header);

    /// The next number. @fails bad_input: the file ends, or the word is no number of this type.
    Result<double> next(PlyType type, std::string_view field);
    /// Bytes not read yet; of text: at most.
    std::size_t left() const;
    /// Bytes that are left and more than white space.
    std::size_t rest() const;
    Place place() const;

private:
    Result<double> next_word(PlyType type, std::string_view field);
    Result<double> next_binary(PlyType type, std::string_view field);

    PlyCoding coding_;
    ByteView bytes_; ///< behind the header
    std::size_t header_size_;
    std::uint64_t header_lines_;
    std::size_t at_ = 0;
    LineScanner lines_;
};

} // namespace meshreel::io
