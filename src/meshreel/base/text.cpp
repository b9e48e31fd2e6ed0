/// Pieces written out.
// SPDX-License-Identifier: MIT
#include "meshreel/base/text.h"

namespace meshreel {

std::string written_out(std::span<const Piece> pieces)
{
    std::string all;
    for (const Piece& piece : pieces) {
        if (piece.kind == Piece::Kind::text) all += piece.text;
        if (piece.kind == Piece::Kind::negative) all += '-';
        if (piece.kind == Piece::Kind::negative || piece.kind == Piece::Kind::whole) all += std::to_string(piece.whole);
#ifndef MESHREEL_DECODER_ALONE // nothing there is joined with a real, and printf is large
        if (piece.kind == Piece::Kind::real) all += std::to_string(piece.real);
#endif
    }
    return all;
}

} // namespace meshreel
