/// Long bodies along a path: tubes with a profile, and the bending of their axis.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "meshreel/mesh/shapes/body.h"
#include "meshreel/mesh/shapes/vec.h"

namespace meshreel::shapes {

/// A tube along x from 0 (nose) to 1 (tail), closed by a pole at each end: a sphere, topologically.
/// place(s, turn) gives the point of ring s in (0, 1) at `turn` in [0, 1) around it; at the poles s is 0 or 1.
/// Exactly `vertices` vertices, >= 8; `around` is the circumference in the length's unit, to get even triangles.
Body tube(std::uint32_t vertices, double around, const std::function<Vec(double s, double turn)>& place);

/// A curve in the ground plane y = 0, given by its direction of travel: heading(u) radians at arc length u.
class Path {
public:
    /// Covers u in [first, last].
    Path(const std::function<double(double u)>& heading, double first, double last);

    struct Place {
        Vec position, forward, side; ///< side: to the right of forward, horizontal
    };
    Place at(double u) const;

private:
    double first_, step_;
    std::vector<Place> places_;
};

} // namespace meshreel::shapes
