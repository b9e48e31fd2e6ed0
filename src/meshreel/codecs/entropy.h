/// Walks meet entropy coders here: the coder that a payload names, writing or reading.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/codecs/contexts.h"
#include "meshreel/codecs/settings.h"
#include "meshreel/coding/huffman.h"
#include "meshreel/coding/range_symbols.h"

namespace meshreel::codecs {

/// The same contexts on both sides: columns for an adaptive coder only.
constexpr ContextGrid grid_of(Entropy entropy)
{
    return {entropy == Entropy::range ? ContextGrid::most_columns : 1};
}

/// Calls body(coder) with the writer that the entropy coder names, and returns the bytes written.
template <class Body>
Bytes written(Entropy entropy, const coding::Contexts& contexts, const Body& body)
{
    const auto all = [&](auto coder) {
        body(coder);
        return coder.finish();
    };
    if (entropy == Entropy::huffman) return all(coding::HuffmanWriter(contexts));
    return all(coding::RangeWriter(contexts));
}

/// The same with a bare range coder, for codecs that mix probabilities of their own.
template <class Body>
Bytes range_written(const Body& body)
{
    coding::RangeEncoder core;
    body(core);
    return core.finish();
}

/// Whether a reader found what it looked for. @fails bad_input: too few bits.
template <class Coder>
Status complete(const Coder& coder)
{
    if (coder.overrun()) return bad_input("ends too early");
    return Ok{};
}

/// Calls body(core) with a bare range decoder. @fails as complete().
template <class Body>
Status range_taken(ByteView bits, const Body& body)
{
    coding::RangeDecoder core(bits);
    body(core);
    return complete(core);
}

/// Calls body(coder) with the reader that the entropy coder names. @fails as complete().
template <class Body>
Status taken(Entropy entropy, ByteView bits, const coding::Contexts& contexts, const Body& body)
{
    const auto all = [&](auto opened) -> Status {
        MESHREEL_TRY(auto coder, std::move(opened));
        body(coder);
        return complete(coder);
    };
    if (entropy == Entropy::huffman) return all(coding::HuffmanReader::open(bits, contexts));
    return all(coding::RangeReader::open(bits, contexts));
}

} // namespace meshreel::codecs
