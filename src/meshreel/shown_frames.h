/// The frames that a decoder was asked for: which stored ones, mixed how, and their positions out of the segments.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshreel/codecs/codec.h"
#include "meshreel/container/segments.h"
#include "meshreel/mesh/frame_mix.h"
#include "meshreel/meshreel.h"

namespace meshreel {

/// N frames to show, of F stored ones.
struct ShownFrames {
    std::vector<double> times_s; ///< [N]
    double fps = 0.0;            ///< as Metadata::fps
    std::vector<FrameMix> mixes; ///< [N]
    bool as_stored = false;      ///< all F frames as they are
};

/// What options.frames and options.fps ask for. times_s: [F] of the file. most: frames that fit in memory. @fails usage: no such frame, a rate that is no
/// number above 0, a step beside a rate.
Result<ShownFrames> shown_frames(const std::vector<double>& times_s, const Metadata& meta, const DecodeOptions& options,
                                 std::uint64_t most);

/// Where the positions come from.
struct CodedFrames {
    const codecs::Codec& codec;
    container::SegmentSource& segments;
    const connectivity::Surface& surface;
    const DecodeOptions& options;
    const std::vector<std::uint32_t>* wanted = nullptr; ///< surface vertices, of a level of detail; null: all
};

/// Positions [N x 3W] of the frames shown; W: the vertices wanted, in that order. Only segments with a part in them are asked for, one after the other. Across
/// the border of two segments each adds its parts, so that motion goes on smoothly there.
/// @fails as the codec does.
Result<Matrix<float>> pose_frames(const CodedFrames& coded, const ShownFrames& shown);

} // namespace meshreel
