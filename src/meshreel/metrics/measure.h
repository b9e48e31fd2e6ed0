/// Takes measures: any number of them in one pass over two sources of frames.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "meshreel/mesh/frame_source.h"
#include "meshreel/metrics/metric.h"

namespace meshreel::metrics {

/// A measure to take.
struct Wanted {
    const Metric* metric;
    std::vector<double> parameters = usual_parameters(*metric);
    VertexErrors vertex_errors = {}; ///< where the errors of single vertices go; empty: nowhere
};

/// What was found.
struct Measured {
    std::vector<double> values;    ///< one for each of the metric's
    std::vector<double> per_frame; ///< [F] the first value frame by frame; empty where there is no such thing
};

struct MeasureOptions {
    Threads threads;
    Progress progress = {};
};

/// Takes all measures wanted, reading each frame once; some megabytes of frames are in memory at a time.
/// @fails bad_input: the two have not in common what a measure needs; as the sources do.
Result<std::vector<Measured>> measure(FrameSource& original, FrameSource& distorted, std::span<const Wanted> wanted,
                                      const MeasureOptions& options = {});

/// One measure of animations in memory.
Result<Measured> measure(const Animation& original, const Animation& distorted, const Wanted& wanted,
                         const MeasureOptions& options = {});

/// The number of that name, its measure with its usual parameters: measured("kg", walk, back).
/// @fails usage: no measure has such a value; bad_input as above.
Result<double> measured(std::string_view value, const Animation& original, const Animation& distorted);

} // namespace meshreel::metrics
