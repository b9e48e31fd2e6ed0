/// What is known of a single field: its encoding, its range, its meaning; and numbers in memory.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace meshreel::container {

/// How a field stands in the bytes.
enum class Encoding : std::uint8_t {
    u8,
    u16,
    u32,
    u64,    ///< fixed width
    varint, ///< LEB128: seven bits a byte, low first, the high bit says that more follow; the shortest form only
    zigzag, ///< signed n as the varint of 2n, or of -2n - 1 where n < 0
    f32,
    f64,      ///< IEEE 754, finite
    tag,      ///< four ASCII letters
    text,     ///< varint length, then that many bytes of UTF-8
    bytes,    ///< varint length, then that many bytes
    rest,     ///< all bytes up to the end of the chunk
    constant, ///< these bytes and no other
    count     ///< varint, then that many items
};

/// Which of the reader's limits bounds a value, besides its range.
enum class Limit : std::uint8_t { none, vertices, triangles, frames, memory };

/// Values allowed, both ends included.
struct Range {
    std::uint64_t low = 0;
    std::uint64_t high = std::numeric_limits<std::uint64_t>::max();
    Limit limit = Limit::none;
};
inline constexpr Range any{};
constexpr Range up_to(Limit limit, std::uint64_t low = 0)
{
    return {low, any.high, limit};
}

struct SignedRange {
    std::int64_t low = std::numeric_limits<std::int64_t>::min();
    std::int64_t high = std::numeric_limits<std::int64_t>::max();
};

/// Real values allowed, both ends included; never NaN or infinity.
struct RealRange {
    double low = std::numeric_limits<double>::lowest();
    double high = std::numeric_limits<double>::max();
};
inline constexpr RealRange finite{};
inline constexpr RealRange not_negative{0.0};
inline constexpr RealRange positive{std::numeric_limits<double>::denorm_min()};

/// What only explanations and tables say of a field.
#ifndef MESHREEL_DECODER_ALONE
template <class T>
using Told = T;
#else // nobody asks, so nothing need be kept
template <class T>
struct Told {
    constexpr Told() = default;
    template <class Text>
    constexpr Told(const Text&)
    {
    }
};
#endif

/// All that is known of a field beside its value.
struct Field {
    std::string_view name;
    Encoding encoding = Encoding::u8;
    Told<std::string_view> meaning;
    Range range = {};
    RealRange real = {};
    SignedRange whole = {};
    Told<std::span<const std::string_view>> names = {}; ///< of the values 0, 1, ...
    Told<std::string_view> times = {};                  ///< not empty: an array, and what says how many
};

/// How many items an array has, as a number and in words.
struct Times {
    std::uint64_t count = 0;
    std::string_view text;
};

/// Four letters. The first small: a reader that does not know the type may skip the chunk.
using Tag = std::uint32_t;
constexpr Tag make_tag(const char (&letters)[5])
{
    return static_cast<Tag>(letters[0]) | static_cast<Tag>(letters[1]) << 8 | static_cast<Tag>(letters[2]) << 16 |
           static_cast<Tag>(letters[3]) << 24;
}
std::string name_of(Tag tag);

/// Little-endian numbers in memory; Size bytes of the value.
template <std::size_t Size>
std::uint64_t load(const std::uint8_t* bytes)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < Size; ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
    return value;
}
template <std::size_t Size>
void store(std::uint64_t value, std::uint8_t* bytes)
{
    for (std::size_t i = 0; i < Size; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
}
template <class Real>
Real load_real(const std::uint8_t* bytes)
{
    using Word = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    const Word word = static_cast<Word>(load<sizeof(Real)>(bytes));
    Real value;
    std::memcpy(&value, &word, sizeof value);
    return value;
}
template <class Real>
void store_real(Real value, std::uint8_t* bytes)
{
    using Word = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    Word word;
    std::memcpy(&word, &value, sizeof word);
    store<sizeof(Real)>(word, bytes);
}

constexpr std::uint64_t zigzag(std::int64_t n)
{
    return (static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t n)
{
    return static_cast<std::int64_t>(n >> 1) ^ -static_cast<std::int64_t>(n & 1);
}

} // namespace meshreel::container
