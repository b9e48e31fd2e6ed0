/// How far a decoding is off, measured without decoding bytes: for searches.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/settings.h"
#include "meshreel/codecs/trajectories.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::tune {

/// Holds decodings of a run of frames against the original, which must outlive it.
class Meter {
public:
    /// frames [F x 3W], of whose vertices the triangles speak.
    Meter(MatrixView<const float> frames, std::span<const Triangle> triangles, Threads threads);

    struct Distances {
        double largest = 0.0; ///< of any vertex in any frame, model units
        std::vector<codecs::Nudge>
            nudges; ///< one for each vertex too far off: against what it is off where it is worst
    };
    /// limit: what is nearly too far, model units. @cost O(F W K).
    Distances distances(const codecs::Trajectories& decoded, double limit) const;

    /// The spatial part of STED (7.8), nearly: from some of the frames. The temporal part is far below it in practice.
    /// @cost that of 32 frames, or of 2 million points.
    double sted(const codecs::Trajectories& decoded) const;

    /// The variance over time of the length of an edge: the median over some edges, model units squared. Infinite where
    /// there are none.
    double length_spread() const;

    std::size_t frame_count() const { return frames_.rows; }

private:
    MatrixView<const float> frames_;
    std::span<const Triangle> triangles_;
    Threads threads_;
};

/// The mean length of the edges of the triangles (each counted once a triangle) in one frame; 0 where there are none.
double mean_edge(std::span<const float> frame, std::span<const Triangle> triangles);

} // namespace meshreel::tune
