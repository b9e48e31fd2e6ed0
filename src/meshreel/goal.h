/// A quality in the terms of one animation: what is allowed, and how much of it is used.
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "meshreel/meshreel.h"

namespace meshreel {

/// Every measure that a quality can limit. Allowed: infinite where there is no limit. Reached: 0 where not measured.
struct Measures {
    double kg = 0.0;        ///< KG error, percent
    double rms = 0.0;       ///< root mean squared vertex distance, model units
    double max_error = 0.0; ///< largest vertex distance, model units
    double sted = 0.0;
    double bytes = 0.0; ///< of the whole file
};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// What is told from what nobody sees (docs/quality.md says why): the default.
inline constexpr double unseen_sted = 0.02;
inline constexpr double unseen_percent = 1.0;         ///< largest error beside it, percent of the body diagonal
inline constexpr double unseen_points_percent = 0.05; ///< where there are no edges that STED could look at

/// At most one target, above 0, or bases and step; an effort that there is; a base mesh where the order needs one, of the
/// animation's triangles. @fails usage, naming what excludes what.
Status check_options(const Animation& still, const EncodeOptions& options);

/// Whether anything at all is asked for.
bool asks_anything(const Quality& quality);

/// What a quality allows. diagonal: body diagonal, > 0.
Measures allowed_by(const Quality& quality, const Animation& animation, double diagonal);

/// The largest share of what is allowed that is used: at most 1 keeps all limits.
double excess_of(const Measures& reached, const Measures& allowed);

} // namespace meshreel
