/// Every vertex of every frame moved by a function: what noise, waves and shifts share.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "meshreel/base/parallel.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::distort {

using Shift = std::array<double, 3>;

/// shift_of(f) gives for frame f a function that is called for v = 0 .. V-1 in order with the vertex and where it is, [3],
/// and says by how much it moves, model units. Frames are done in any order.
template <class ShiftOf>
Animation moved(const Animation& animation, Threads threads, const ShiftOf& shift_of)
{
    Animation result = animation;
    parallel_for(animation.frame_count(), threads, [&](std::size_t f) {
        auto shift = shift_of(f);
        const std::span<float> frame = result.frame(f);
        for (std::size_t v = 0; v < animation.vertex_count; ++v) {
            float* const p = frame.data() + 3 * v;
            const Shift by = shift(v, std::span<const float>(p, 3));
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(p[axis] + by[axis]);
        }
    });
    return result;
}

} // namespace meshreel::distort
