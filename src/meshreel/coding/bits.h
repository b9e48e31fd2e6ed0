/// Bits into bytes and back, most significant bit first.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshreel/base/views.h"

namespace meshreel::coding {

/// Appends bits; the last byte is filled with zeros.
class BitWriter {
public:
    /// The low `count` bits of value, highest first; count <= 32.
    void put(std::uint32_t value, int count)
    {
        for (int i = count - 1; i >= 0; --i) {
            if (used_ == 0) bytes_.push_back(0);
            bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | ((value >> i & 1u) << (7 - used_)));
            used_ = (used_ + 1) & 7;
        }
    }
    const Bytes& bytes() const { return bytes_; }
    Bytes take() { return std::move(bytes_); }

private:
    Bytes bytes_;
    int used_ = 0; ///< bits used of the last byte, 0 when it is full
};

/// Takes bits off; past the end it returns zeros and overrun() stays true.
class BitReader {
public:
    explicit BitReader(ByteView bytes) : bytes_(bytes) {}

    std::uint32_t bit()
    {
        if (next_ >= bytes_.size() * 8) {
            overrun_ = true;
            return 0;
        }
        const std::uint32_t value = bytes_[next_ >> 3] >> (7 - (next_ & 7)) & 1u;
        ++next_;
        return value;
    }
    /// The next `count` bits, highest first; count <= 32.
    std::uint32_t get(int count)
    {
        std::uint32_t value = 0;
        for (int i = 0; i < count; ++i) value = value << 1 | bit();
        return value;
    }
    bool overrun() const { return overrun_; }
    /// Bits taken so far.
    std::uint64_t position() const { return next_; }

private:
    ByteView bytes_;
    std::uint64_t next_ = 0;
    bool overrun_ = false;
};

} // namespace meshreel::coding
