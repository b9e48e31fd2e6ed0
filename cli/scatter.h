/// A picture of a study: every measure against the scores, one panel each.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "meshreel/io/scores.h"

namespace meshreel::cli {

/// An SVG: in each panel a point a stimulus, the measure to the right, the score upwards, a colour a dataset; over it the measure's
/// name and Pearson's coefficient of all points.
std::string scatter_picture(const io::Scores& scores);

} // namespace meshreel::cli
