/// Memory that will be read soon, asked for early: a hint that changes no result.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace meshreel {

/// Asks for all of some values.
template <class T>
inline void prefetch(std::span<T> values)
{
    constexpr std::size_t line = 64 / sizeof(T);
    static_assert(line > 0);
    for (std::size_t i = 0; i < values.size(); i += line) __builtin_prefetch(values.data() + i);
}

} // namespace meshreel
