/// Packing bytes with zstd; encoder side.
// SPDX-License-Identifier: MIT
#include <new>
#include <zstd.h>

#include "meshreel/container/squeeze.h"

namespace meshreel::container {

Squeezed squeeze(Bytes bytes, int level)
{
    Squeezed squeezed;
    squeezed.size = bytes.size();
    Bytes packed(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level);
    if (ZSTD_isError(size) != 0) throw std::bad_alloc(); // there is room enough, so nothing else can be wrong
    if (size < bytes.size()) {
        packed.resize(size);
        packed.shrink_to_fit();
        squeezed.method = Squeezed::Method::zstd;
        bytes = std::move(packed);
    }
    squeezed.kept = std::move(bytes);
    squeezed.data = squeezed.kept;
    return squeezed;
}

} // namespace meshreel::container
