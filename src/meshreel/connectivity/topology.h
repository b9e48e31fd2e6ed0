/// The room's front door: a triangle list with welded vertices in, bytes out, and back.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/limits.h"
#include "meshreel/base/order.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/connectivity/surface.h"

namespace meshreel::connectivity {

/// V vertices, of which those with equal trajectories are one vertex of the surface.
struct Input {
    std::uint32_t vertex_count = 0;      ///< V
    std::span<const Triangle> triangles; ///< [T] over V
    std::span<const std::uint32_t>
        unique_of; ///< [V] class 0 .. W-1 by first occurrence (mesh/weld.h); empty: all differ
};

/// What encoder and decoder both know when the connectivity is through.
struct Topology {
    Surface surface;                       ///< W vertices in the order met: what codecs code
    std::uint32_t vertex_count = 0;        ///< V
    std::vector<Triangle> triangles;       ///< [T] the output's triangle list, over V
    std::vector<std::uint32_t> surface_of; ///< [V] surface vertex of each output vertex
};

/// The bytes, what the decoder will make of them, and where each output element stood in the input.
struct Encoded {
    Bytes bytes;
    Topology topology;
    std::vector<std::uint32_t> vertex_of;   ///< [V] input vertex of each output vertex; 0 1 2 ... unless Order::free
    std::vector<std::uint32_t> corner_of;   ///< [3T] input corner (3 t + i) of each output corner; likewise
    std::vector<std::uint32_t> original_of; ///< [W] an input vertex that stands for each surface vertex
};

/// Codes the connectivity. Any triangle list is taken. @param input every index below V.
/// @cost O(V + T log T).
Encoded encode(const Input& input, Order order);

/// The fields of the bytes, for those who explain a file; an Io is one of container/fields.h. decode() reads the same.
struct PayloadFields {
    std::uint32_t kind = 0;
    std::uint64_t vertex_count = 0, triangle_count = 0;
    ByteView bits;

    void fields(auto& io)
    {
        io.varint("kind", kind, {0, 15}, "order + 4 x method: 0 given, 1 shell, 2 sequence, 3 reordered");
        io.varint("vertex_count", vertex_count, {0, 0xfffffff0}, "V");
        io.varint("triangle_count", triangle_count, {0, 0xffffffff}, "T");
        io.rest("bits", bits, "one range-coded stream, see docs/connectivity.md");
    }
};

/// Decodes what encode() made with Order::keep or Order::free. @fails bad_input by byte and field: cut, malformed, or
/// above the limits.
Result<Topology> decode(ByteView bytes, const DecodeLimits& limits);

/// Decodes what encode() made, of any order; `base` is the base mesh's triangle list, used by Order::base alone.
/// @fails bad_input: as above, or base has other counts than the encoder's list or an index out of range.
Result<Topology> decode(ByteView bytes, std::span<const Triangle> base, const DecodeLimits& limits);

} // namespace meshreel::connectivity
