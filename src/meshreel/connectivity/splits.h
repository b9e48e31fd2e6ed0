/// Welded vertices: which of them are one on the surface, and which of its copies each corner uses.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/coding/range_coder.h"
#include "meshreel/connectivity/surface.h"

namespace meshreel::connectivity {

/// Which output vertices each surface vertex stands for.
struct Members {
    std::vector<std::uint32_t> begin;    ///< [W + 1] places in vertices
    std::vector<std::uint32_t> vertices; ///< [V] output vertices, rising within each surface vertex

    std::span<const std::uint32_t> of(std::uint32_t s) const
    {
        return std::span(vertices).subspan(begin[s], begin[s + 1] - begin[s]);
    }
    bool all_alone() const { return vertices.size() + 1 == begin.size(); }
};

/// @param surface_of [V] surface vertex of each vertex.
Members members_of(std::uint32_t surface_vertices, std::span<const std::uint32_t> surface_of);

/// Order kept: the class of each vertex, numbered by first occurrence. About a byte if all differ.
void write_classes(coding::RangeEncoder& coder, std::span<const std::uint32_t> class_of);
/// @return [V] classes. @fails bad_input: cut, or a class that is not yet met.
Result<std::vector<std::uint32_t>> read_classes(coding::RangeDecoder& coder, std::uint32_t vertex_count);

/// Order free: how many output vertices each surface vertex has, those numbered surface vertex by surface vertex.
void write_counts(coding::RangeEncoder& coder, const Members& members);
/// @return members of 0 .. V-1 in order. @fails bad_input: cut, or other than V vertices in all.
Result<Members> read_counts(coding::RangeDecoder& coder, std::uint32_t surface_vertices, std::uint32_t vertex_count);

/// The output vertex at each corner of the surface's triangles [3T]: a guess is the copy that the last triangle at this
/// surface vertex used.
void write_corners(coding::RangeEncoder& coder, const Surface& surface, const Members& members,
                   std::span<const std::uint32_t> vertex_at);
/// @fails bad_input: cut, or a copy that is not there.
Result<std::vector<std::uint32_t>> read_corners(coding::RangeDecoder& coder, const Surface& surface,
                                                const Members& members);

} // namespace meshreel::connectivity
