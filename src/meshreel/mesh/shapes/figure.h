/// A human figure at rest, arms stretched out: its skin, and what each bone holds of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/mesh/shapes/body.h"
#include "meshreel/mesh/shapes/vec.h"

namespace meshreel::shapes {

/// The bones, each after the one it hangs on. Left is +x, up is +y, the figure looks along +z.
enum class Bone : std::uint8_t {
    pelvis,
    chest,
    head,
    left_upper_arm,
    left_forearm,
    right_upper_arm,
    right_forearm,
    left_thigh,
    left_shin,
    left_foot,
    right_thigh,
    right_shin,
    right_foot
};
constexpr std::size_t bone_count = 13;

struct Joint {
    Bone parent;
    Vec at; ///< where the bone turns, at rest, metres
};
/// The joint of each bone; the pelvis is its own parent.
const std::array<Joint, bone_count>& joints();

struct Figure {
    Body body;             ///< closed, of genus 0, about 1.75 m high, standing on y = 0; grouped by limb
    Matrix<double> weight; ///< [V x bones], each row sums to 1
};

/// Exactly `vertices` vertices. @cost O(V^1.5): weights are smoothed over a fixed width, ring by ring.
Figure figure(std::uint32_t vertices);

} // namespace meshreel::shapes
