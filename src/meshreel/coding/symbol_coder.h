/// What a walk asks of an entropy coder, so that encoder and decoder can share the walk.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>

namespace meshreel::coding {

/// A coder of small integers in numbered contexts. A Writer (writes == true) stores `wanted` and returns it; a Reader
/// ignores `wanted` and returns what was stored. Past the end of its bytes a Reader returns zeros and overrun() is true.
template <class C>
concept SymbolCoder = requires(C coder, std::uint32_t context, std::int32_t wanted)
{
    {
        C::writes
        } -> std::convertible_to<bool>;
    {
        coder.level(context, wanted)
        } -> std::same_as<std::int32_t>; ///< any signed value, small ones cheap
    {
        coder.symbol(context, wanted)
        } -> std::same_as<std::int32_t>; ///< 0 .. alphabet-1, the alphabet set per context
    {
        coder.bits(wanted, 5)
        } -> std::same_as<std::int32_t>; ///< n raw bits, n <= 31
};

} // namespace meshreel::coding
