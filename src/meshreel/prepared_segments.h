/// The segments of an animation on their way into a file, of which one is in memory at a time.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/mesh/frame_source.h"
#include "meshreel/segmenting.h"

namespace meshreel {

/// What the segments are made of; all of it must outlive them.
struct SegmentInput {
    FrameSource& source;
    const connectivity::Encoded& topology;
    const codecs::Codec& codec;
    Threads threads;
};

/// Reads the frames of a segment whenever it is visited, all into the same place. What a codec has prepared is kept as long
/// as it is small beside that; otherwise it is prepared again.
class PreparedSegments {
public:
    explicit PreparedSegments(const SegmentInput& input);

    /// Says where the segments are. Before anything else.
    void cut(std::vector<FrameSpan> spans);

    /// Visits all segments, so that their spectra are known. Earlier preparations are forgotten.
    /// @fails as the source does.
    Status prepare(std::size_t max_bases);

    /// A segment in memory, until the next one is visited.
    struct Visit {
        const codecs::Encoder& encoder;
        MatrixView<const float> frames; ///< [F x 3W] in surface order
    };
    /// @pre prepare() was called. @fails as the source does.
    Result<Visit> visit(std::size_t s);

    std::size_t count() const { return spans_.size(); }
    FrameSpan span(std::size_t s) const { return spans_[s]; }
    std::span<const FrameSpan> spans() const { return spans_; }
    std::size_t longest() const;
    std::size_t max_bases() const { return max_bases_; }
    std::span<const Spectrum> spectra() const { return spectra_; }

private:
    MatrixView<const float> held(std::size_t s) const;
    Status load(std::size_t s);
    void keep_or_drop(std::size_t s);

    SegmentInput input_;
    std::vector<FrameSpan> spans_;
    std::size_t max_bases_ = 0;
    std::vector<Spectrum> spectra_;
    std::vector<std::unique_ptr<codecs::Encoder>> encoders_; ///< null: to be prepared again
    std::size_t kept_bytes_ = 0, loose_, held_; ///< loose: prepared, but to be dropped with the next; held: in frames_
    std::vector<float> frames_;                 ///< of the segment held; encoders of others look here too
};

} // namespace meshreel
