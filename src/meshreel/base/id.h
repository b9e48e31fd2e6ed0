/// Strong indices: a vertex number can never be taken for a corner number.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace meshreel {

/// An index of one kind of thing. Default: none.
template <class Tag>
struct Id {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    constexpr Id() = default;
    constexpr explicit Id(std::uint32_t index) : value(index) {}

    constexpr bool valid() const { return value != none; }
    friend constexpr bool operator==(Id, Id) = default;
    friend constexpr auto operator<=>(Id, Id) = default;

    std::uint32_t value = none;
};

using VertexId = Id<struct VertexTag>;     ///< 0 .. V-1
using TriangleId = Id<struct TriangleTag>; ///< 0 .. T-1
using CornerId = Id<struct CornerTag>;     ///< 0 .. 3T-1; corner c belongs to triangle c / 3

} // namespace meshreel
