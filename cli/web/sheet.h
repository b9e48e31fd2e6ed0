/// An animation as the page takes it that is no .reel file: a head in JSON, then arrays, then every float32 of its frames.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/byte_source.h"
#include "meshreel/base/parallel.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::cli {

/// u32 little-endian: bytes of the JSON; JSON; spaces up to a multiple of 4; triangles u32 [T x 3]; row of each vertex,
/// those that move as one sharing it, u32 [V]; of each attribute its values, filled up to a multiple of 4, and its indices
/// u32; positions float32 [F x V x 3]. js/play/sheet.js reads it.
class Sheet : public ByteSource {
public:
    explicit Sheet(const Animation& animation, Threads threads); ///< the animation must outlive it

    std::uint64_t size() const override { return beginning_.size() + positions().size(); }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override;

private:
    ByteView positions() const;

    const Animation& animation_;
    Bytes beginning_; ///< all before the positions
};

} // namespace meshreel::cli
