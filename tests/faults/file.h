/// A .reel file in parts that a test can change and put together again, with checksums that hold.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "meshreel/base/file.h"

namespace meshreel::faults {

struct Part {
    std::string type; ///< four letters
    Bytes payload;
};

/// All chunks, INDX and TAIL too.
std::vector<Part> parts_of(ByteView file);

/// The parts as they are, each with the size and checksum that belong to it.
Bytes sealed(const std::vector<Part>& parts);

/// The same with an index and a tail that say what is there: a fault gets behind every check of the container's.
Bytes indexed(std::vector<Part> parts);

/// A field of a payload, by `explain`.
struct Field {
    std::size_t part = 0, begin = 0, size = 0; ///< of which part; bytes in its payload
    std::string name;
};
std::vector<Field> fields_of(ByteView file);

/// The files of tests/golden, by name, and one of them.
std::vector<std::string> golden_names();
Bytes golden_file(const std::string& name);

/// A file of a codec, of few vertices, with everything that a file can hold.
Bytes small_file(const std::string& codec);

} // namespace meshreel::faults
