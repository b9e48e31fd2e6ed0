/// Numbers of a PLY file by their declared types.
// SPDX-License-Identifier: MIT
#include "meshreel/io/ply_source.h"

#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/io/binary_read.h"

namespace meshreel::io {

namespace {

struct Range {
    std::int64_t low, high;
};
constexpr Range ranges[] = {{-128, 127},      {0, 255}, {-32768, 32767}, {0, 65535}, {-2147483648ll, 2147483647},
                            {0, 4294967295ll}};

std::optional<double> number_in(std::string_view word, PlyType type)
{
    if (type == PlyType::f32) return to_float(word); // rounded once, not first to a double
    if (type == PlyType::f64) return to_double(word);
    const auto number = to_integer(word);
    const Range range = ranges[static_cast<std::size_t>(type)];
    if (!number || *number < range.low || *number > range.high) return std::nullopt;
    return static_cast<double>(*number);
}

double binary_number(const std::uint8_t* at, PlyType type, ByteOrder order)
{
    switch (type) {
    case PlyType::i8:
        return number_at<std::int8_t>(at, order);
    case PlyType::u8:
        return number_at<std::uint8_t>(at, order);
    case PlyType::i16:
        return number_at<std::int16_t>(at, order);
    case PlyType::u16:
        return number_at<std::uint16_t>(at, order);
    case PlyType::i32:
        return number_at<std::int32_t>(at, order);
    case PlyType::u32:
        return number_at<std::uint32_t>(at, order);
    case PlyType::f32:
        return number_at<float>(at, order);
    case PlyType::f64:
        return number_at<double>(at, order);
    }
    return 0;
}

} // namespace

PlySource::PlySource(ByteView bytes, const PlyHeader& header)
    : coding_(header.coding), bytes_(bytes.subspan(header.size)), header_size_(header.size),
      header_lines_(header.lines), lines_(bytes_)
{
}

Result<double> PlySource::next(PlyType type, std::string_view field)
{
    return coding_ == PlyCoding::text ? next_word(type, field) : next_binary(type, field);
}

Result<double> PlySource::next_word(PlyType type, std::string_view field)
{
    std::string_view word = lines_.word();
    while (word.empty()) {
        if (!lines_.next_line()) return bad_input("the file ends before this number", std::string(field), place());
        word = lines_.word();
    }
    const auto number = number_in(word, type);
    if (number) return *number;
    return bad_input(in_quotes(word) + " is no number of the property's type", std::string(field), place());
}

Result<double> PlySource::next_binary(PlyType type, std::string_view field)
{
    const std::size_t size = size_of(type);
    if (size > bytes_.size() - at_) return bad_input("the file ends before this number", std::string(field), place());
    const double number =
        binary_number(bytes_.data() + at_, type, coding_ == PlyCoding::little ? ByteOrder::little : ByteOrder::big);
    at_ += size;
    return number;
}

std::size_t PlySource::left() const
{
    return bytes_.size() - (coding_ == PlyCoding::text ? lines_.offset() : at_);
}

std::size_t PlySource::rest() const
{
    if (coding_ != PlyCoding::text) return left();
    const ByteView after = bytes_.subspan(lines_.offset());
    return static_cast<std::size_t>(std::ranges::count_if(after, [](std::uint8_t c) { return c > ' '; }));
}

Place PlySource::place() const
{
    if (coding_ == PlyCoding::text) return at_line(header_lines_ + std::max<std::uint64_t>(lines_.line(), 1));
    return at_byte(header_size_ + at_);
}

} // namespace meshreel::io
