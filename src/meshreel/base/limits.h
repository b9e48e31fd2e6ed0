/// What a file may ask for. Checked before anything is allocated.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "meshreel/base/result.h"

namespace meshreel {

/// Upper bounds on what a reader or decoder accepts.
struct DecodeLimits {
    std::uint64_t max_vertices = 100'000'000;  ///< V
    std::uint64_t max_triangles = 200'000'000; ///< T
    std::uint64_t max_frames = 1'000'000;      ///< F
    std::uint64_t max_memory = 16ull << 30;    ///< bytes that one file may make us hold
};

/// Refuses a count that is above its limit, naming the field.
Status within(std::uint64_t count, std::uint64_t limit, std::string_view field);

/// Refuses counts whose animation would not fit the limits: F x V x 3 floats and T triangles.
Status within(const DecodeLimits& limits, std::uint64_t vertices, std::uint64_t triangles, std::uint64_t frames);

} // namespace meshreel
