/// The calls by which files are written, made to fail.
// SPDX-License-Identifier: MIT
//
// The test program's own open, write, fsync, close, rename and link stand before the C library's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace meshreel::machine {

enum class Call : std::uint8_t { open, write, fsync, close, rename, link };
inline constexpr std::array calls{Call::open, Call::write, Call::fsync, Call::close, Call::rename, Call::link};
inline constexpr std::array call_names{"open", "write", "fsync", "close", "rename", "link"};

/// How a write fails.
enum class How : std::uint8_t {
    refused,     ///< with an error number
    short_first, ///< half the bytes are written, the next call fails: what a disk does that becomes full
    interrupted, ///< once, by EINTR: to be repeated
    in_pieces    ///< a few bytes at a time, always: not a failure
};

/// While it lives, calls are counted, and one of them fails.
class Fault {
public:
    static constexpr std::size_t none = ~std::size_t{0};

    Fault() = default;
    /// The call of that kind and number, from 0.
    Fault(Call call, std::size_t number, int error, How how = How::refused);
    ~Fault();
    Fault(const Fault&) = delete;
    Fault& operator=(const Fault&) = delete;

    /// Whether it came to that.
    bool happened() const;
};

/// Counts the calls of a kind, while it lives.
class Count {
public:
    Count();
    ~Count();
    Count(const Count&) = delete;
    Count& operator=(const Count&) = delete;
    std::size_t of(Call call) const;
};

} // namespace meshreel::machine
