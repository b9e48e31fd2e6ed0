/// The two animations of a comparison as pictures see them: frames on demand, and which of them carries the errors.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "cli/pictures/colour_map.h"
#include "cli/pictures/heat.h"
#include "cli/pictures/render.h"
#include "meshreel/mesh/frame_source.h"

namespace meshreel::cli {

/// What is drawn.
struct Surfaces {
    FrameSource* original = nullptr;
    FrameSource* distorted = nullptr;
    const Heat* heat = nullptr; ///< not empty
    double range = 0.0;         ///< top of the colour scale; 0: from the errors
    Axis up = Axis::unknown;    ///< unknown: as the original says, else y

    bool counterparts = false; ///< vertex i of one is vertex i of the other, in equal triangles and as many frames

    /// The errors stand on the distorted surface where its vertices are the original's, else on the original.
    bool on_distorted() const { return counterparts; }
    FrameSource& coloured() const { return on_distorted() ? *distorted : *original; }
    Axis upright() const { return up != Axis::unknown ? up : original->still().meta.up; }
    /// The scale asked for, or one that the largest finite error fits.
    Scale scale_for(std::span<const double> errors) const
    {
        double largest = 0.0;
        for (double error : errors)
            if (std::isfinite(error)) largest = std::max(largest, error);
        return range > 0.0 ? scale_of(range) : scale_up_to(largest);
    }
};

} // namespace meshreel::cli
