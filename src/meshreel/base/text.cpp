/// Pieces written out.
// SPDX-License-Identifier: MIT
#include "meshreel/base/text.h"

#ifndef MESHREEL_DECODER_ALONE
#include <charconv>
#include <iterator>
#endif

namespace meshreel {

#ifndef MESHREEL_DECODER_ALONE // nothing there is joined with a real, and its digits are large
namespace {

/// As short as they go: a field from outside may be 1e300, or 1e-300.
std::string six_digits(double real)
{
    char digits[32];
    const auto end = std::to_chars(digits, std::end(digits), real, std::chars_format::general, 6).ptr;
    return {digits, end};
}

} // namespace
#endif

std::string written_out(std::span<const Piece> pieces)
{
    std::string all;
    for (const Piece& piece : pieces) {
        if (piece.kind == Piece::Kind::text) all += piece.text;
        if (piece.kind == Piece::Kind::negative) all += '-';
        if (piece.kind == Piece::Kind::negative || piece.kind == Piece::Kind::whole) all += std::to_string(piece.whole);
#ifndef MESHREEL_DECODER_ALONE
        if (piece.kind == Piece::Kind::real) all += six_digits(piece.real);
#endif
    }
    return all;
}

} // namespace meshreel
