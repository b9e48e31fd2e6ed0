/// The three functions of libzstd that the decoder calls, in a build that has no libzstd.
// SPDX-License-Identifier: MIT
#pragma once

#include "unzstd.h"

inline constexpr unsigned long long ZSTD_CONTENTSIZE_ERROR = 0ull - 2;

inline unsigned long long ZSTD_getFrameContentSize(const std::uint8_t* data, std::size_t size)
{
    const auto frame = meshreel::wasm::look_at_zstd({data, size});
    return frame && frame->content_size ? *frame->content_size : ZSTD_CONTENTSIZE_ERROR;
}

inline std::size_t ZSTD_findFrameCompressedSize(const std::uint8_t* data, std::size_t size)
{
    const auto frame = meshreel::wasm::look_at_zstd({data, size});
    return frame ? static_cast<std::size_t>(frame->compressed_size) : ~std::size_t{0};
}

inline std::size_t ZSTD_decompress(std::uint8_t* out, std::size_t room, const std::uint8_t* data, std::size_t size)
{
    return meshreel::wasm::unpack_zstd({data, size}, {out, room}) ? room : ~std::size_t{0};
}
