/// Numbers from the bytes of a binary file, each read checked against its end.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "meshreel/base/result.h"
#include "meshreel/base/text.h"
#include "meshreel/base/views.h"

namespace meshreel::io {

enum class ByteOrder : std::uint8_t { little, big };

/// The number at `at`, which must have sizeof(Number) bytes.
template <class Number>
Number number_at(const std::uint8_t* at, ByteOrder order)
{
    using Bits =
        std::conditional_t<sizeof(Number) == 1, std::uint8_t,
                           std::conditional_t<sizeof(Number) == 2, std::uint16_t,
                                              std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>>;
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
        const std::size_t shift = 8 * (order == ByteOrder::little ? i : sizeof(Number) - 1 - i);
        bits = static_cast<Bits>(bits | static_cast<Bits>(static_cast<Bits>(at[i]) << shift));
    }
    Number number{};
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

/// Walks over bytes; every read names its field.
class BinaryReader {
public:
    BinaryReader(ByteView bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

    std::size_t offset() const { return at_; }
    std::size_t left() const { return bytes_.size() - at_; }

    /// The next number. @fails bad_input: the file ends first.
    template <class Number>
    Result<Number> number(std::string_view field)
    {
        MESHREEL_CHECK(need(sizeof(Number), field));
        const Number value = number_at<Number>(bytes_.data() + at_, order_);
        at_ += sizeof(Number);
        return value;
    }
    /// The next `size` bytes. @fails bad_input: the file ends first.
    Result<ByteView> bytes(std::uint64_t size, std::string_view field)
    {
        MESHREEL_CHECK(need(size, field));
        const ByteView view = bytes_.subspan(at_, size);
        at_ += size;
        return view;
    }
    /// A name of `size` bytes, up to its first zero byte.
    Result<std::string> name(std::size_t size, std::string_view field)
    {
        MESHREEL_TRY(const ByteView view, bytes(size, field));
        std::string text(view.begin(), view.end());
        return text.substr(0, text.find('\0'));
    }
    /// Goes to an offset from the beginning. @fails bad_input: it is behind the end.
    Status seek(std::uint64_t offset, std::string_view field)
    {
        if (offset > bytes_.size())
            return bad_input(concat("stands at byte ", offset, ", but the file has ", bytes_.size()),
                             std::string(field), at_byte(at_));
        at_ = static_cast<std::size_t>(offset);
        return Ok{};
    }
    /// @fails bad_input: fewer than `size` bytes are left.
    Status need(std::uint64_t size, std::string_view field) const
    {
        if (size <= left()) return Ok{};
        return bad_input(concat("needs ", size, " bytes, but ", left(), " are left"), std::string(field), at_byte(at_));
    }

private:
    ByteView bytes_;
    ByteOrder order_;
    std::size_t at_ = 0;
};

/// Copies float32 values. bytes.size() == 4 * out.size().
inline void copy_floats(ByteView bytes, ByteOrder order, float* out)
{
    const std::size_t count = bytes.size() / 4;
    for (std::size_t i = 0; i < count; ++i) out[i] = number_at<float>(bytes.data() + 4 * i, order);
}

/// Appends the bytes of a number in the order asked for.
template <class Number>
void append_number(Bytes& bytes, Number number, ByteOrder order)
{
    std::uint8_t raw[sizeof(Number)];
    std::memcpy(raw, &number, sizeof raw);
    const std::uint16_t probe = 1;
    const bool machine_is_little = *reinterpret_cast<const std::uint8_t*>(&probe) == 1;
    const bool swap = machine_is_little != (order == ByteOrder::little);
    for (std::size_t i = 0; i < sizeof raw; ++i) bytes.push_back(raw[swap ? sizeof raw - 1 - i : i]);
}

} // namespace meshreel::io
