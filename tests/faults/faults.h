/// Faults, one after the other in a system; each must end in an error or a valid mesh, within time and memory.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "meshreel/base/file.h"

namespace meshreel::faults {

/// How many files were decoded, and what became of them.
struct Tally {
    std::uint64_t refused = 0, valid = 0;
    std::size_t peak = 0;   ///< bytes held at most by one decode, beside the file
    double longest_s = 0.0; ///< processor time of one decode

    std::uint64_t tried() const { return refused + valid; }
    Tally& operator+=(const Tally& more);
    std::string sentence() const; ///< all of it
};

/// Every file that is cut off; each is refused.
Tally truncations(ByteView file, std::size_t stride = 1);

/// Every payload that is cut off, or one byte longer, in a file whose checksums and index hold.
Tally truncated_payloads(ByteView file, std::size_t stride = 1);

/// Every flipped bit of the file; each is refused.
Tally flipped_bits(ByteView file, std::size_t stride = 1);

/// Every flipped bit of a payload, in a file whose checksums and index hold.
Tally flipped_payload_bits(ByteView file, std::size_t stride = 1);

/// Every pair of chunks swapped, every chunk repeated at every place and every chunk left out; index as it was, or as it must be.
Tally shuffled_chunks(ByteView file);

/// Every field of at most ten bytes at 0, 1, the largest number and the one below, as a varint of any length and as bytes
/// of the field's own length; index as it was, or as it must be.
Tally wild_fields(ByteView file);

} // namespace meshreel::faults
