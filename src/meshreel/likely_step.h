/// The step a search begins with, told from spectra alone.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "meshreel/codecs/settings.h"
#include "meshreel/goal.h"
#include "meshreel/segmenting.h"

namespace meshreel {

/// What is known of a motion before any of it is encoded.
struct MotionFigures {
    std::uint32_t coded_vertices = 0;       ///< W
    double diagonal = 1.0;                  ///< body diagonal, > 0
    double mean_edge = 0.0;                 ///< of the first frame
    std::span<const Spectrum> spectra = {}; ///< of all segments
};

/// |A - E(A)| of (5.2).
double norm_of(std::span<const Spectrum> spectra);

/// The step D at which the error should be about what is allowed, model units; > 0. A guess: an attempt corrects it.
double likely_step(const MotionFigures& motion, const Measures& allowed, const codecs::Settings& settings);

} // namespace meshreel
