/// Feeds any bytes to the small zstd decoder and to libzstd: what both unpack is the same.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <zstd.h>

#include "wasm/unzstd.cpp"

using namespace meshreel;

namespace {

constexpr std::uint64_t most_bytes = 1 << 20;

void compare(ByteView frame)
{
    const auto found = wasm::look_at_zstd(frame);
    const unsigned long long promised = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (!found || !found->content_size || *found->content_size > most_bytes) return;
    if (promised != *found->content_size) return;
    Bytes ours(static_cast<std::size_t>(promised)), theirs(static_cast<std::size_t>(promised));
    const ByteView whole = frame.first(static_cast<std::size_t>(found->compressed_size));
    const bool unpacked = wasm::unpack_zstd(whole, ours);
    const std::size_t size = ZSTD_decompress(theirs.data(), theirs.size(), whole.data(), whole.size());
    if (size == theirs.size() && (!unpacked || ours != theirs)) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const ByteView bytes(data, size);
    compare(bytes);
    Bytes packed(ZSTD_compressBound(size)), back(size);
    packed.resize(ZSTD_compress(packed.data(), packed.size(), data, size, 1 + static_cast<int>(size % 19)));
    if (!wasm::unpack_zstd(packed, back) || !std::equal(back.begin(), back.end(), data)) std::abort();
    return 0;
}
