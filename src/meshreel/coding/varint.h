/// Integers of any size in one to ten bytes (LEB128), signed ones folded onto the unsigned (zigzag).
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"

namespace meshreel::coding {

/// 0 -1 1 -2 2 ... becomes 0 1 2 3 4 ...
constexpr std::uint64_t zigzag(std::int64_t value)
{
    return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t folded)
{
    return static_cast<std::int64_t>(folded >> 1) ^ -static_cast<std::int64_t>(folded & 1);
}

/// Appends seven bits a byte, low ones first; the top bit says that more follow.
inline void put_varint(Bytes& bytes, std::uint64_t value)
{
    for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 0x80));
    bytes.push_back(static_cast<std::uint8_t>(value));
}

/// Reads fields one after the other and remembers where it stands.
class VarintReader {
public:
    explicit VarintReader(ByteView bytes) : bytes_(bytes) {}

    /// @fails bad_input: the bytes end inside the number, or it does not fit 64 bits; names the byte and the field.
    Result<std::uint64_t> number(std::string_view field)
    {
        std::uint64_t value = 0;
        const std::size_t start = next_;
        for (int shift = 0; next_ < bytes_.size(); shift += 7) {
            const std::uint64_t part = bytes_[next_++];
            if (shift == 63 && part > 1) return error("does not fit 64 bits", field, start);
            value |= (part & 0x7f) << shift;
            if (part < 0x80) return value;
        }
        return error("the bytes end here", field, start);
    }
    /// The next `count` bytes. @fails bad_input: fewer are left.
    Result<ByteView> block(std::uint64_t count, std::string_view field)
    {
        if (count > bytes_.size() - next_) return error("the bytes end before this block does", field, next_);
        next_ += count;
        return bytes_.subspan(next_ - count, count);
    }
    ByteView rest() const { return bytes_.subspan(next_); }
    std::uint64_t offset() const { return next_; }

private:
    static Error error(const char* what, std::string_view field, std::uint64_t offset)
    {
        return bad_input(what, std::string(field), at_byte(offset));
    }

    ByteView bytes_;
    std::size_t next_ = 0;
};

} // namespace meshreel::coding
