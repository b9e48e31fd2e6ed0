/// Builds a sentence from pieces, without a formatting library: the decoder must stay small.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "meshreel/base/result.h"

namespace meshreel {

/// A text or a number, until it is written out.
struct Piece {
    enum class Kind : std::uint8_t { text, whole, negative, real } kind;
    std::string_view text = {};
    std::uint64_t whole = 0; ///< of a negative one, without its sign
    double real = 0.0;

    Piece(std::string_view value) : kind(Kind::text), text(value) {}
    Piece(const char* value) : kind(Kind::text), text(value) {}
    Piece(const std::string& value) : kind(Kind::text), text(value) {}
    template <std::integral Whole>
    Piece(Whole value)
        : kind(value < 0 ? Kind::negative : Kind::whole),
          whole(value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value))
    {
    }
    Piece(double value) : kind(Kind::real), real(value) {}
};

/// All of them, one after the other.
std::string written_out(std::span<const Piece> pieces);

/// joined(chunk, ".", field).
template <class... Pieces>
std::string joined(const Pieces&... pieces)
{
    const Piece all[] = {Piece(pieces)...};
    return written_out(all);
}

/// A sentence: concat("frame ", 7, " has ", n, " vertices").
#ifndef MESHREEL_DECODER_ALONE
template <class... Pieces>
Sentence concat(const Pieces&... pieces)
{
    return joined(pieces...);
}
#else // where every byte counts, its longest literal must do: " vertices"
template <class... Pieces>
constexpr Sentence concat(const Pieces&... pieces)
{
    Sentence longest;
    const auto look = [&](const auto& piece) {
        if constexpr (std::is_array_v<std::remove_reference_t<decltype(piece)>>)
            if (sizeof(piece) > longest.size()) longest = {piece, sizeof(piece) - 1};
    };
    (look(pieces), ...);
    return longest;
}
#endif

} // namespace meshreel
