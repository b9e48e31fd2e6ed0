/// Frames that are asked for a run at a time: from memory, from files, from a decoder.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

/// An animation whose positions need not be in memory. Any run of frames can be asked for, again and again, and is the
/// same each time.
class FrameSource {
public:
    virtual ~FrameSource() = default;

    /// All but the positions, which nobody may use: V, triangles, times, appearance, metadata.
    virtual const Animation& still() const = 0;

    /// Positions of frames first .. first + count - 1, [count x 3V], finite; valid while `room` is left alone, into which
    /// they are written where they are not in memory anyway. @pre the source has these frames
    /// @fails io, bad_input: as the source says; among others where a file has changed since it was read first.
    virtual Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) = 0;

    std::size_t frame_count() const { return still().frame_count(); }
};

/// An animation in memory, which must outlive it.
class HeldFrames : public FrameSource {
public:
    explicit HeldFrames(const Animation& animation) : animation_(animation) {}

    const Animation& still() const override { return animation_; }
    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override;

private:
    const Animation& animation_;
};

/// How many frames of V vertices a pass over a source takes at a time: some megabytes.
std::size_t frames_a_run(std::uint32_t vertex_count);

/// Calls body(first, frames), a Status, for all frames of a source, run after run, until it fails.
template <class Body>
Status for_frame_runs(FrameSource& source, const Body& body)
{
    Matrix<float> room;
    const std::size_t F = source.frame_count(), run = frames_a_run(source.still().vertex_count);
    for (std::size_t first = 0; first < F; first += run) {
        MESHREEL_TRY(const MatrixView<const float> frames, source.frames(first, std::min(run, F - first), room));
        MESHREEL_CHECK(body(first, frames));
    }
    return Ok{};
}

} // namespace meshreel
