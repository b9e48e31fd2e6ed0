/// Small animations by hand, for closed-form values.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::made {

/// One frame a second.
inline Animation points(std::uint32_t count, std::vector<float> positions, std::vector<Triangle> triangles = {})
{
    Animation animation;
    animation.vertex_count = count;
    animation.times_s = uniform_times(positions.size() / (3ul * count), 1.0);
    animation.positions = std::move(positions);
    animation.triangles = std::move(triangles);
    return animation;
}

} // namespace meshreel::made
