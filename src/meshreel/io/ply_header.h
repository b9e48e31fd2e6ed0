/// The header of a PLY file: which numbers follow.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel::io {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class PlyCoding : std::uint8_t { text, little, big };

/// Bytes of one binary number.
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::f32;
    std::optional<PlyType> count_type; ///< set: a list, its length first
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Fewest bytes that one row can have: text needs two a number, one of them the space between.
    std::size_t smallest_row(PlyCoding coding) const;
};

struct PlyHeader {
    PlyCoding coding = PlyCoding::text;
    std::vector<PlyElement> elements;
    std::vector<std::string> materials, groups; ///< names in our own comments, in order
    std::size_t size = 0;                       ///< bytes up to the first number
    std::uint64_t lines = 0;
};

/// @fails bad_input: by line.
Result<PlyHeader> parse_ply_header(ByteView bytes);

/// "comment meshreel material NAME": names that PLY itself has no place for.
constexpr std::string_view ply_comment_tag = "meshreel";

} // namespace meshreel::io
