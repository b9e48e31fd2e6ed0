/// The cheapest encoding that keeps a limit, in few attempts.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "meshreel/base/progress.h"
#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/settings.h"

namespace meshreel::tune {

/// One point of the search: what it is, costs and gives.
struct Attempt {
    codecs::Settings settings;
    double excess = 0.0; ///< what is limited over its limit: kept where at most 1; >= 0
    double cost = 0.0;   ///< what should be small: bytes where the error is limited, an error where bytes are; >= 0
    std::vector<Bytes> payloads;                         ///< one a segment
    std::uint32_t bases = 0;                             ///< K, of the segment that has most
    double step = 0.0;                                   ///< D, model units
    std::vector<std::vector<codecs::Nudge>> nudges = {}; ///< of each segment, for vertices that miss the limit
    double mean_square = 0.0;                            ///< of what a vertex is off, model units squared
};

/// A setting worth varying, and how: up and down by a factor, within a range.
struct Knob {
    double codecs::Settings::*setting;
    double factor; ///< > 1
    double least, most;
};

struct Problem {
    std::function<Result<Attempt>(const codecs::Settings&)> attempt; ///< encodes, and measures nearly
    std::function<Result<double>(const Attempt&)> verify;            ///< the excess that counts, of the decoded file
    bool rises = true;            ///< the excess rises with the step, as errors do; sizes fall
    std::vector<Knob> knobs = {}; ///< varied one after another, each for as long as it pays
    int rounds = 1;               ///< how often all of them; between rounds Settings::growth falls by 1 where that pays
    double spread = std::numeric_limits<double>::infinity(); ///< of lengths, Meter::length_spread
    double telling = 0.1; ///< where the spread is this part of what attempts are off at most, Settings::relax is tried
                          ///< before the knobs, then Settings::lengths
    Progress progress = {};
    std::function<Result<Attempt>(Attempt)> mend = {}; ///< the same settings again, where a few vertices miss the limit
};

/// The cheapest attempt found that verifies at most 1, and 0.97 or more where any step gives that: first the step by
/// secants on logarithms, where errors and sizes are nearly linear in it; then the knobs, each new point held against the
/// best as if both kept the limit exactly; then the step again, until verified. settings.step of `start` is the first
/// guess. Two to five attempts, two or three more a knob; an attempt that misses the limit by a little is mended first.
/// @fails missed: the limit is not kept at any step tried; whatever attempt or verify fails with.
Result<Attempt> cheapest(const Problem& problem, const codecs::Settings& start);

} // namespace meshreel::tune
