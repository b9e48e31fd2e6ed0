/// What a file may ask for. Checked before anything is allocated.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "meshreel/base/result.h"

namespace meshreel {

/// Upper bounds on what a reader or decoder accepts. The last two bound what a small .reel file may cause: a file of n bytes
/// becomes at most 64 MiB + 10^6 n bytes, by at most 256 multiplications for each of its coordinates and 4 10^6 n more.
struct DecodeLimits {
    std::uint64_t max_vertices = 100'000'000;  ///< V
    std::uint64_t max_triangles = 200'000'000; ///< T
    std::uint64_t max_frames = 1'000'000;      ///< F
    std::uint64_t max_memory = 16ull << 30;    ///< bytes that one file may make us hold
    std::uint64_t max_expansion = 1'000'000;   ///< bytes of frames a byte of the file, beyond the first 64 MiB
    std::uint64_t max_work = 4'000'000; ///< products a byte of a segment or scene, beyond 256 a coordinate or pose

    static constexpr std::uint64_t free_bytes = 64ull << 20;
    static constexpr std::uint64_t free_work = 256;
};

/// Refuses a count that is above its limit, naming the field.
Status within(std::uint64_t count, std::uint64_t limit, std::string_view field);

/// Refuses counts whose animation would not fit the limits: F x V x 3 floats and T triangles.
Status within(const DecodeLimits& limits, std::uint64_t vertices, std::uint64_t triangles, std::uint64_t frames);

/// Refuses frames of so many bytes out of a file of so many.
Status within_expansion(const DecodeLimits& limits, std::uint64_t decoded_bytes, std::uint64_t file_bytes);

/// Refuses so many sums of K products each out of so many bytes: the coordinates of a segment, the frames of a scene.
Status within_work(const DecodeLimits& limits, std::uint64_t sums, std::uint64_t K, std::uint64_t bytes);

} // namespace meshreel
