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

namespace {

/// Whether part <= per x count, which may be beyond 64 bits.
bool at_most(std::uint64_t part, std::uint64_t per, std::uint64_t count)
{
    return count != 0 && (part / count < per || (part / count == per && part % count == 0));
}

} // namespace

Status within_expansion(const DecodeLimits& limits, std::uint64_t decoded_bytes, std::uint64_t file_bytes)
{
    if (decoded_bytes <= DecodeLimits::free_bytes) return Ok{};
    if (at_most(decoded_bytes - DecodeLimits::free_bytes, limits.max_expansion, file_bytes)) return Ok{};
    return bad_input(concat(file_bytes, " bytes would become ", decoded_bytes, ", above the limit of ",
                            limits.max_expansion, " each"));
}

Status within_work(const DecodeLimits& limits, std::uint64_t sums, std::uint64_t K, std::uint64_t bytes)
{
    if (K <= DecodeLimits::free_work || sums == 0) return Ok{};
    const std::uint64_t more = K - DecodeLimits::free_work, most = ~std::uint64_t{0} / sums;
    if (more <= most && at_most(more * sums, limits.max_work, bytes)) return Ok{};
    return bad_input(
        concat(sums, " sums of ", K, " products are above the limit of ", limits.max_work, " multiplications a byte"));
}

} // namespace meshreel
