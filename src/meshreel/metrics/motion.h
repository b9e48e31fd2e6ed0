/// What metrics compare: two motions of the same triangles, in single or double precision.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::metrics {

/// Two motions of the same V vertices over the same F frames. T is float or double.
template <class T>
struct Pair {
    MatrixView<const T> original;        ///< [F x 3V], x y z of each vertex
    MatrixView<const T> distorted;       ///< [F x 3V]
    std::span<const Triangle> triangles; ///< of both

    std::size_t frame_count() const { return original.rows; }
    std::size_t vertex_count() const { return original.cols / 3; }
};

inline MatrixView<const float> frames_of(const Animation& animation)
{
    return {animation.positions.data(), animation.frame_count(), animation.vertex_count * std::size_t{3}};
}
inline Pair<float> pair_of(const Animation& original, const Animation& distorted)
{
    return {frames_of(original), frames_of(distorted), original.triangles};
}

} // namespace meshreel::metrics
