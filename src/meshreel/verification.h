/// A file decoded again, segment by segment, and held against what it was made from.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "meshreel/base/byte_source.h"
#include "meshreel/mesh/frame_source.h"
#include "meshreel/metrics/vertex_error.h"

namespace meshreel {

struct VerificationOptions {
    std::span<const std::uint32_t> vertex_of; ///< [V] the source's vertex of each of the file's
    const Animation* base = nullptr;          ///< of a file made with Order::base
    bool sted = false;                        ///< measure that too
    Threads threads = {};
};

/// How far a file is off, as the measures of the whole animations have it, to the bit.
struct Difference {
    double kg = 0.0; ///< percent
    metrics::VertexError vertex_error;
    std::optional<double> sted;
};

/// Decodes all of a file, a segment in memory at a time. @fails as decode() and the source do; missed, with its field: the
/// file would be refused, as positions became infinite.
Result<Difference> difference(ByteSource& file, FrameSource& source, const VerificationOptions& options);

} // namespace meshreel
