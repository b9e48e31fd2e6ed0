/// What every codec of the registry can be asked for.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "meshreel/base/parallel.h"

namespace meshreel {

/// How the PCA basis is coded (thesis 8.1.2, 8.4). What is stored in a file counts from 0: new ones go last.
enum class BasisCoding : std::uint8_t {
    raw,     ///< float32 values
    uniform, ///< one step for all components, no prediction (Amjoun)
    cobra,   ///< predicted in time by motion, non-uniform steps (thesis 8.4, 8.5)
    lpc1,    ///< Cobra's steps, but predicted by sent weights of the value before (Karni and Gotsman, thesis 3.1.10)
    lpc2,    ///< ... of the two values before
    lpc3,    ///< ... of three
    lpc4     ///< ... of four
};

/// Their names, in their order.
inline constexpr std::array<std::string_view, 7> basis_coding_names = {"raw",  "uniform", "cobra", "lpc1",
                                                                       "lpc2", "lpc3",    "lpc4"};

/// How residuals become bits.
enum class Entropy : std::uint8_t {
    huffman, ///< a code table a component, as in the thesis
    range    ///< adaptive binary contexts and a range coder
};

namespace codecs {

/// Has a vertex coded as if it were elsewhere in one frame, so that it comes out nearer to where it is.
struct Nudge {
    std::uint32_t vertex = 0, frame = 0; ///< in surface order; of the segment
    std::array<double, 3> shift{};       ///< model units
};

/// One point on a codec's rate-distortion surface.
struct Settings {
    double step = 0.0;                       ///< D, quantisation step of the coefficients, model units; 0: as coarse as
                                             ///< the last of the bases allows
    std::optional<std::uint32_t> bases = {}; ///< K; none: the components with s_k / sqrt(W) >= truncation * D
    double truncation = 0.65;                ///< tau, see bases; > 0
    double bit_price = 0.0;                  ///< squared steps that saving a bit is worth, >= 0; 0 rounds (reel)
    double taper = 0.15;                     ///< steps of coarse levels: D times the share of coarser vertices to that
                                             ///< power, [0, 1] (reel)
    double first_ratio = 1.0;                ///< step of the components that give the geometry over D, > 0 (reel)
    double linear = 150.0;                   ///< trust in motions known already against smoothness, >= 0 (reel)
    double squared_bend = 1.0;               ///< up to which distance, squared, motions are smooth, > 0 (reel)
    std::uint32_t growth = 8;                ///< weights are found anew after so many eighths of the components known
                                             ///< more; the more, the faster, >= 1 (reel)
    bool mixed = true;                       ///< several contexts for each level; one is faster (reel)
    std::uint32_t neighbours = 16;           ///< that a vertex is interpolated from, 1 .. 16; fewer are faster (reel)
    bool lengths = false;                    ///< guesses keep distances to neighbours that hardly vary (reel)
    bool relax = false;                      ///< decoded frames are drawn towards edge lengths that hardly vary (reel)
    double basis_ratio = 1.0;                ///< beta: Q_m = beta D / sqrt(W), see basis_law; > 0
    BasisCoding basis = BasisCoding::cobra;
    Entropy entropy = Entropy::range;
    std::vector<Nudge> nudges = {}; ///< vertices that came out too far off in one frame (all codecs over PCA)
    Threads threads = {};
};

} // namespace codecs
} // namespace meshreel
