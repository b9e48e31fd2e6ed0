/// What a distortion is: an animation made worse in one way, by a stated amount. The registry.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "meshreel/base/parallel.h"
#include "meshreel/base/result.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::distort {

/// What an amount counts.
enum class Unit : std::uint8_t {
    length, ///< model units, >= 0
    count,  ///< a whole number
    share   ///< a fraction, (0, 1]
};

/// How strong, and which of the many possible ones.
struct Request {
    double amount = 0.0; ///< in the distortion's unit
    std::optional<double> omega =
        {};                 ///< of waves: radians a model unit, or a frame, of the distortion's own choice by default
    std::uint64_t seed = 1; ///< of noise
    Threads threads = {};
};

/// One row of the registry.
struct Distortion {
    std::string_view name;    ///< "noise-vertex", as in `meshreel distort`
    std::string_view summary; ///< one line; what the amount is
    std::string_view source;  ///< where the thesis or another has it
    Unit unit = Unit::length;
    double nothing = 0.0;      ///< the amount that changes no bit
    bool more_is_worse = true; ///< else less is
    bool has_omega = false, has_seed = false;
    bool keeps_mesh = true; ///< V and triangles; F and the times always stay
    /// The request is checked, and asks for something.
    Result<Animation> (*apply)(const Animation& animation, const Request& request);
};

/// Every distortion, in the order of the documentation.
std::span<const Distortion> all();

/// The distortion of that name, or null.
const Distortion* find(std::string_view name);

/// Distorts a valid animation; the result is valid, and the same for any number of threads. Attributes stay with the vertices,
/// corners and triangles that they belong to; normals stay what they were.
/// @fails usage: an amount out of its range, or so large that a position leaves float32; omega where there is no wave.
Result<Animation> distort(const Distortion& distortion, const Animation& animation, const Request& request);

} // namespace meshreel::distort
