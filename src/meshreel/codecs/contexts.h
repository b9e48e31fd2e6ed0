/// What walks share: contexts (a row a component, a column for how much went wrong nearby), and how they meet any bytes.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

namespace meshreel::codecs {

/// |level|, capped so that sums of a few cannot overflow.
constexpr std::uint32_t magnitude(std::int32_t level)
{
    const std::uint32_t size = level < 0 ? 0u - static_cast<std::uint32_t>(level) : static_cast<std::uint32_t>(level);
    return std::min(size, 0xffffu);
}

/// Numbers contexts. An adaptive coder gets a column a magnitude; a coder with stored tables only the rows, as in the
/// thesis (8.1.3: a context a component).
struct ContextGrid {
    std::uint32_t columns = most_columns;

    static constexpr std::uint32_t most_columns = 10;

    constexpr std::uint32_t index(std::uint32_t row, std::uint32_t nearby) const
    {
        return row * columns + std::min(column(nearby), columns - 1);
    }
    constexpr std::uint32_t size(std::uint32_t rows) const { return rows * columns; }

private:
    /// 0 for 0, then about two columns an octave.
    static constexpr std::uint32_t column(std::uint32_t nearby)
    {
        std::uint32_t count = 0;
        for (std::uint32_t first : {1u, 2u, 3u, 5u, 8u, 12u, 20u, 36u, 80u}) count += nearby >= first ? 1 : 0;
        return count;
    }
};

/// What a decoder may do with any bytes, it must be able to go on with.
inline double bounded(double value)
{
    constexpr double most = 1e30;
    return value > -most && value < most ? value : 0.0;
}

/// Whether a reader has run out of bits: then a walk may stop, what follows is refused anyway.
template <class Coder>
bool ended(const Coder& coder)
{
    if constexpr (Coder::writes)
        return false;
    else
        return coder.overrun();
}

} // namespace meshreel::codecs
