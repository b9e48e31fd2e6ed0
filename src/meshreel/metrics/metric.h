/// Measures of the difference between two animations of the same connectivity: the registry.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "meshreel/base/parallel.h"
#include "meshreel/base/result.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::metrics {

/// What a metric promises not to see when both animations undergo it.
struct Invariance {
    bool translation, rotation, scale;
};

/// One row of the registry.
struct Metric {
    std::string_view name;   ///< "kg", as in --kg and in JSON
    std::string_view title;  ///< "KG error"
    std::string_view unit;   ///< "%", "units", "dB", ""
    std::string_view source; ///< "thesis (5.2)"
    double equal;            ///< the value of equal animations: 0, or infinity where larger is better
    Invariance invariance;
    /// original and distorted have the same V and F (see comparable). Larger is worse, but for PSNR.
    double (*measure)(const Animation& original, const Animation& distorted, Threads threads);
};

/// Every metric, in the order of the documentation.
std::span<const Metric> all();

/// The metric of that name, or null.
const Metric* find(std::string_view name);

/// Says why two animations cannot be compared vertex by vertex: V or F differ, or the triangles do.
Status comparable(const Animation& original, const Animation& distorted);

} // namespace meshreel::metrics
