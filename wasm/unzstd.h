/// One zstd frame (RFC 8878) unpacked, in little code: attributes and assets of a file are packed so.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "meshreel/base/views.h"

namespace meshreel::wasm {

/// What a frame says of itself.
struct ZstdFrame {
    std::optional<std::uint64_t> content_size; ///< of its bytes, unpacked; none: it does not say
    std::uint64_t compressed_size = 0;         ///< of the whole frame, its checksum included
    std::uint64_t head_size = 0;
};

/// Walks from block to block. Nothing: not a whole frame, or one that needs a dictionary.
std::optional<ZstdFrame> look_at_zstd(ByteView frame);

/// Unpacks a frame that fills `out` exactly. Any bytes may be given. Its own checksum, if it has one, is not looked at: every
/// chunk of a file has one. @return whether it did.
bool unpack_zstd(ByteView frame, std::span<std::uint8_t> out);

} // namespace meshreel::wasm
