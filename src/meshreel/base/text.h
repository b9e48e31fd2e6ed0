/// Builds a sentence from pieces, without a formatting library: the decoder must stay small.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

namespace meshreel {

inline std::string piece(std::string_view text)
{
    return std::string(text);
}
template <class Number>
requires std::is_arithmetic_v<Number> std::string piece(Number number)
{
    return std::to_string(number);
}

/// concat("frame ", 7, " has ", n, " vertices").
template <class... Pieces>
std::string concat(const Pieces&... pieces)
{
    std::string all;
    (all.append(piece(pieces)), ...);
    return all;
}

} // namespace meshreel
