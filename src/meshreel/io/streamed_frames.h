/// Frames that stay in their files until they are asked for.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "meshreel/io/io.h"
#include "meshreel/mesh/frame_source.h"

namespace meshreel::io {

/// What formats that can be read frame by frame share: every frame is checked when it is read, and remembered by a hash,
/// so that a file that changes while it is read again and again is noticed.
class StreamedFrames : public FrameSource {
public:
    const Animation& still() const override { return still_; }
    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override;

protected:
    explicit StreamedFrames(Animation still = {}) : still_(std::move(still)) {}

    /// Frame i, [V x 3].
    virtual Status read_frame(std::size_t i, std::span<float> positions) = 0;
    /// What frame i is called in errors, and the file that it is in.
    virtual std::uint64_t number(std::size_t i) const = 0;
    virtual const std::string& file(std::size_t i) const = 0;

    Animation still_;

private:
    Status check(std::size_t i, std::span<const float> positions);

    std::vector<std::uint64_t> hashes_; ///< [F] 0: not read yet
};

/// An animation that is a source of its own frames.
class OwnedFrames : public FrameSource {
public:
    explicit OwnedFrames(Animation animation) : animation_(std::move(animation)), held_(animation_) {}

    const Animation& still() const override { return animation_; }
    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override
    {
        return held_.frames(first, count, room);
    }

private:
    Animation animation_;
    HeldFrames held_;
};

/// All frames in memory. @fails bad_input: above the limits; as the source does.
Result<Animation> gathered(FrameSource& source, const LoadOptions& options);

/// The source itself, or its frames in memory where they are few: for formats that are slow to read again.
Result<std::unique_ptr<FrameSource>> held_if_small(std::unique_ptr<FrameSource> source, const LoadOptions& options);

} // namespace meshreel::io
