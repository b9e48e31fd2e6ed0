/// Vertices that move as one: welding of identical trajectories.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/mesh/frame_source.h"

namespace meshreel {

/// The classes 0 .. W-1 of vertices whose positions agree bit for bit in every frame, numbered by first occurrence.
struct Weld {
    std::vector<std::uint32_t> unique_of; ///< [V] class of each vertex
    std::vector<std::uint32_t> first_of;  ///< [W] first vertex of each class, rising

    std::uint32_t unique_count() const { return static_cast<std::uint32_t>(first_of.size()); }
};

struct WeldOptions {
    Threads threads;
    std::uint64_t hash_mask = ~0ull; ///< bits of the trajectory's hash that are used; for tests: 0 makes all collide
};

/// Finds the vertices with identical trajectories. Bits decide: -0.0 and 0.0 differ, so that splitting gives back what
/// was there. Equal hashes are always verified.
/// @cost O(V F) time, 24 bytes a vertex beside the result.
/// Reads the frames twice: to hash, and to verify.  @fails as the source does.
Result<Weld> weld(FrameSource& source, const WeldOptions& options);
/// Of an animation in memory.
Weld weld(const Animation& animation, const WeldOptions& options);
inline Weld weld(const Animation& animation, Threads threads = {})
{
    return weld(animation, WeldOptions{threads});
}

} // namespace meshreel
