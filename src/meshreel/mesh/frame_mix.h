/// Frames between frames: the stored frames, and their weights, that make the frame at any time.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

/// A frame as a weighted sum of stored frames. A single one of weight 1 is that frame, bit for bit.
struct FrameMix {
    struct Part {
        std::uint32_t frame = 0;
        double weight = 0.0;
    };
    std::array<Part, 4> parts;
    std::uint32_t count = 0; ///< parts used, 1 .. 4; their frames differ

    std::span<const Part> used() const { return {parts.data(), count}; }
};

/// Frames wanted of a run of stored frames. Parts of a mix that the run does not have count nothing: runs add up.
struct Mixes {
    std::span<const FrameMix> wanted;
    std::size_t first = 0; ///< number of the run's first frame
};

/// The stored frame f and nothing else.
FrameMix only(std::uint32_t frame);

/// Frames [N x n] mixed from those of a run, stored [F x n].
void mix(MatrixView<const float> stored, const Mixes& mixes, MatrixView<double> frames);

/// When the stored frames are.
struct Timeline {
    std::span<const double> times_s; ///< [F], strictly increasing
    double period_s = 0.0;           ///< of a loop: the first frame comes again so long after itself; 0: no loop
};

/// The timeline of an animation that repeats if `meta` says so. The first frame follows the last one after 1 / fps, or
/// after the mean distance of two frames where no fps is known.
Timeline timeline_of(std::span<const double> times_s, const Metadata& meta);

/// The frame at time t: a cubic between its two neighbours, its speed in each that of the parabola through the frame and
/// its own two neighbours. Exactly through the stored frames, which a time within a millionth of their distance means;
/// quadratic motion comes back as it was. Before the first frame (and, without a period, after the last) it stays.
/// @cost O(log F)
FrameMix mix_at(const Timeline& timeline, double t);

/// Times 1 / fps apart, from frame `first` to frame `last`; all of a timeline with a period: up to the next first frame.
/// fps > 0. @fails usage: more than `most` frames.
Result<std::vector<double>> times_between(const Timeline& timeline, std::array<std::uint64_t, 2> first_last, double fps,
                                          std::uint64_t most);

} // namespace meshreel
