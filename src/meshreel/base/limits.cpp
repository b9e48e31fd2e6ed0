/// The limits' sentences.
// SPDX-License-Identifier: MIT
#include "meshreel/base/limits.h"

#include "meshreel/base/text.h"

namespace meshreel {

Status within(std::uint64_t count, std::uint64_t limit, std::string_view field)
{
    if (count <= limit) return Ok{};
    return bad_input(concat(count, " is above the limit of ", limit), std::string(field));
}

Status within(const DecodeLimits& limits, std::uint64_t vertices, std::uint64_t triangles, std::uint64_t frames)
{
    MESHREEL_CHECK(within(vertices, limits.max_vertices, "vertex_count"));
    MESHREEL_CHECK(within(triangles, limits.max_triangles, "triangle_count"));
    MESHREEL_CHECK(within(frames, limits.max_frames, "frame_count"));
    constexpr std::uint64_t bytes_a_position = 12, bytes_a_triangle = 12;
    const std::uint64_t triangle_bytes = triangles * bytes_a_triangle;
    const bool fits = triangle_bytes <= limits.max_memory &&
                      (vertices == 0 || frames <= (limits.max_memory - triangle_bytes) / bytes_a_position / vertices);
    if (fits) return Ok{};
    return bad_input(concat(frames, " frames of ", vertices, " vertices do not fit in the memory limit of ",
                            limits.max_memory, " bytes"));
}

} // namespace meshreel
