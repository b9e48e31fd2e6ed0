/// An adaptive binary range coder: 32-bit integers, 15-bit probabilities, the same bytes on every machine.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "meshreel/base/views.h"

namespace meshreel::coding {

/// What is known about one binary decision. Two estimates learn side by side, one fast and one slow, and a mean
/// of them is used that leans on the slow one; both begin by counting, so that a context seen a few times only is still useful.
class Bit {
public:
    static constexpr int precision = 15;

    /// Probability of a one, in 2^-15, never 0 and never certain.
    std::uint32_t one() const
    {
        constexpr std::uint32_t least = 8;
        return std::clamp((fast_ + 3 * slow_) >> (state_bits + 2 - precision), least, (1u << precision) - least);
    }
    void learn(bool bit)
    {
        const std::uint32_t rate = rates[count_];
        move(fast_, bit, std::max(rate, least_fast_rate));
        move(slow_, bit, rate);
        if (count_ + 1u < rates.size()) ++count_;
    }

private:
    static constexpr int state_bits = 24, rate_bits = 15;
    static constexpr std::uint32_t least_fast_rate = (1u << rate_bits) / 28;
    /// 1 / (n + 1.6) after n symbols; the last one stays.
    static constexpr std::array<std::uint32_t, 250> rates = [] {
        std::array<std::uint32_t, 250> table{};
        for (std::uint32_t n = 0; n < table.size(); ++n) table[n] = (10u << rate_bits) / (10 * n + 16);
        return table;
    }();
    static void move(std::uint32_t& state, bool bit, std::uint32_t rate)
    {
        const std::uint64_t distance = bit ? (1u << state_bits) - state : state;
        const auto change = static_cast<std::uint32_t>(distance * rate >> rate_bits);
        state = bit ? state + change : state - change;
    }

    std::uint32_t fast_ = 1u << (state_bits - 1); ///< probability of a one, in 2^-24
    std::uint32_t slow_ = 1u << (state_bits - 1);
    std::uint32_t count_ = 0;
};

/// Whether models learn from what a coder is told: not from a Price.
template <class Coder>
inline constexpr bool learns = true;

/// Writes decisions. bit() and raw() return what they were given, as a Decoder returns what it found.
class RangeEncoder {
public:
    static constexpr bool writes = true;

    bool bit(Bit& model, bool wanted)
    {
        decide(model.one(), wanted);
        model.learn(wanted);
        return wanted;
    }
    /// A decision whose probability of a one, 1 .. 2^15 - 1 in 2^-15, somebody else keeps.
    bool decide(std::uint32_t one, bool wanted)
    {
        const std::uint32_t bound = (range_ >> Bit::precision) * one;
        low_ += wanted ? 0 : bound;
        range_ = wanted ? bound : range_ - bound;
        while (range_ < least_range) shift();
        return wanted;
    }
    /// The low `count` bits of value, all values equally likely; count <= 32.
    std::uint32_t raw(std::uint32_t value, int count)
    {
        for (int left = count; left > 0; left -= 16) {
            const int now = std::min(left, 16);
            range_ >>= now;
            low_ += static_cast<std::uint64_t>(range_) * (value >> (left - now) & ((1u << now) - 1u));
            while (range_ < least_range) shift();
        }
        return value;
    }
    /// Bytes written so far; what is still inside is at most four more.
    std::size_t size() const { return bytes_.size(); }
    /// What Decoder::position() will say here, if the stream goes on long enough.
    std::uint64_t position() const { return bytes_.size() + 4; }
    /// Ends the stream: the shortest bytes that, followed by zeros, decode to what was written.
    Bytes finish()
    {
        const std::uint64_t end = (low_ + least_range - 1) & ~std::uint64_t{least_range - 1};
        low_ = end;
        shift();
        if (!bytes_.empty() && bytes_.back() == 0) bytes_.pop_back();
        return std::move(bytes_);
    }

private:
    static constexpr std::uint32_t least_range = 1u << 24;

    void shift()
    {
        if (low_ >> 32 != 0) {
            for (std::size_t i = bytes_.size(); i > 0 && ++bytes_[i - 1] == 0; --i) {
            }
        }
        bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
        low_ = (low_ & 0xffffff) << 8;
        range_ <<= 8;
    }

    Bytes bytes_;
    std::uint64_t low_ = 0; ///< 32 bits and a carry
    std::uint32_t range_ = 0xffffffff;
};

/// Reads decisions. Past the end it reads zeros; overrun() tells when more was read than an encoder would have left out.
class RangeDecoder {
public:
    static constexpr bool writes = false;

    explicit RangeDecoder(ByteView bytes) : bytes_(bytes)
    {
        for (int i = 0; i < 4; ++i) code_ = code_ << 8 | next();
    }

    bool bit(Bit& model, bool = false)
    {
        const bool one = decide(model.one());
        model.learn(one);
        return one;
    }
    bool decide(std::uint32_t probability, bool = false)
    {
        const std::uint32_t bound = (range_ >> Bit::precision) * probability;
        const bool one = code_ < bound;
        code_ -= one ? 0 : bound;
        range_ = one ? bound : range_ - bound;
        refill();
        return one;
    }
    std::uint32_t raw(std::uint32_t, int count)
    {
        std::uint32_t value = 0;
        for (int left = count; left > 0; left -= 16) {
            const int now = std::min(left, 16);
            range_ >>= now;
            const std::uint32_t part = std::min(code_ / range_, (1u << now) - 1u);
            code_ -= part * range_;
            value = value << now | part;
            refill();
        }
        return value;
    }
    bool overrun() const { return read_ > bytes_.size() + 4; }
    /// Bytes taken so far, at most the number there are.
    std::uint64_t position() const { return std::min<std::uint64_t>(read_, bytes_.size()); }

private:
    static constexpr std::uint32_t least_range = 1u << 24;

    std::uint32_t next()
    {
        const std::uint64_t at = read_++;
        return at < bytes_.size() ? bytes_[at] : 0u;
    }
    void refill()
    {
        while (range_ < least_range) {
            code_ = code_ << 8 | next();
            range_ <<= 8;
        }
    }

    ByteView bytes_;
    std::uint64_t read_ = 0;
    std::uint32_t code_ = 0;
    std::uint32_t range_ = 0xffffffff;
};

} // namespace meshreel::coding
