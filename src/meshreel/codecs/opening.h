/// From a file's head to what its segments need: the codec it names and the surface it codes.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/container/package.h"

namespace meshreel::codecs {

/// The codec that a file names. @fails unsupported.
Result<const Codec*> codec_of(const container::Header& header);

/// The connectivity of a file, of the counts that its header says. base: for Order::base, may be null for others.
/// @fails usage: no base, or not the one the file was made with; bad_input by byte and field.
Result<connectivity::Topology> read_topology(const container::StreamReader& file, const container::Header& header,
                                             const Animation* base);

} // namespace meshreel::codecs
