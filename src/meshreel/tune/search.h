/// The smallest encoding whose distortion is at most a target.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "meshreel/base/progress.h"
#include "meshreel/base/result.h"
#include "meshreel/codecs/settings.h"

namespace meshreel::tune {

/// What one point of the search costs and gives.
struct Attempt {
    codecs::Settings settings; ///< settings.bases is always set: the K that was used
    std::uint64_t size = 0;    ///< bytes
    double distortion = 0.0;   ///< in the target's unit, >= 0
};

struct Problem {
    std::function<Result<Attempt>(const codecs::Settings&)> attempt; ///< encodes and measures
    double target = 0.0;                                             ///< distortion at most this, > 0
    std::vector<double> truncations; ///< values of Settings::truncation worth a look, best guess first; not empty
    bool refine = true;              ///< also vary K and the share of the basis around the best
    Progress progress;
};

/// The smallest attempt found with distortion <= target, usually above 0.99 target. `start` says everything but step,
/// bases, truncation and basis_ratio; its step is the first guess.
/// Distortion must fall with the step, on the whole; then some twenty attempts are made.
/// @fails missed: even the finest steps stay above the target; whatever attempt fails with.
Result<Attempt> smallest(const Problem& problem, codecs::Settings start);

/// The attempt with the coarsest step whose distortion is at most the target, all other settings given; none where the
/// finest steps stay above it. settings.step is the first guess.
Result<std::optional<Attempt>> coarsest(const Problem& problem, const codecs::Settings& settings);

} // namespace meshreel::tune
