/// Attributes read and written value by value: what the text formats share.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshreel/io/io.h"

namespace meshreel::io {

constexpr std::uint32_t no_value = 0xffffffff; ///< this element has no value

/// A table of floats as an attribute, a value an element.
Attribute float_attribute(std::string name, Domain domain, std::uint8_t components, std::span<const float> values);

/// The same attribute, each element with the place of its value in the table.
Attribute indexed(Attribute attribute, std::vector<std::uint32_t> indices);

/// One number a triangle, such as material and group: without indices where every triangle has one.
/// @param numbers  [T], no_value where a triangle has none.
Attribute triangle_numbers(std::string name, std::span<const std::uint32_t> numbers);

/// The number of a triangle in an attribute of one u32, u16 or u8; no_value where it has none.
std::uint32_t triangle_number(const Attribute& attribute, std::size_t triangle);

/// The place in the table of values that belongs to a corner, or no_value. Domain vertex or corner.
std::uint32_t corner_value(const Attribute& attribute, const Animation& animation, std::size_t corner);

/// For each vertex the place of its value in the table, or no_value. Nothing: a triangle attribute, or one that gives
/// a vertex different values at different corners.
std::optional<std::vector<std::uint32_t>> vertex_values(const Attribute& attribute, const Animation& animation);

/// One number of a table. Normalized integers become fractions of 1.
float attribute_float(const Attribute& attribute, std::size_t value, std::size_t component);

/// One number of a table of integers, as it is. The type must not be f32.
std::int64_t attribute_integer(const Attribute& attribute, std::size_t value, std::size_t component);

/// Appends the little-endian bytes of a number.
void append_little(Bytes& bytes, float number);
void append_little(Bytes& bytes, std::uint32_t number);
void append_little(Bytes& bytes, std::uint16_t number);

/// Warns of each attribute that a file cannot hold, those not among `held`, and of textures that travel along.
void tell_left_out(const Animation& animation, std::span<const std::string_view> held, const SaveOptions& options);

} // namespace meshreel::io
