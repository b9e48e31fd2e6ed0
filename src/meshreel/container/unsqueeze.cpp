/// Unpacking bytes; every size is known, allowed and plausible before anything is allocated.
// SPDX-License-Identifier: MIT
#include <zstd.h>
#ifndef MESHREEL_DECODER_ALONE
#include <zstd_errors.h>
#endif

#include "meshreel/base/text.h"
#include "meshreel/container/squeeze.h"

namespace meshreel::container {

namespace {

/// A zstd block holds at most 128 KB and takes at least four bytes.
constexpr std::uint64_t block_size = 128u << 10, least_block = 4;

} // namespace

Status Budget::lend(std::uint64_t bytes, std::string_view field) const
{
    if (bytes <= left_) return Ok{};
    return bad_input(concat(bytes, " bytes do not fit in what the memory limit leaves, ", left_), std::string(field));
}

Status Budget::take(std::uint64_t bytes, std::string_view field)
{
    MESHREEL_CHECK(lend(bytes, field));
    left_ -= bytes;
    return Ok{};
}

Result<Bytes> unsqueeze(const Squeezed& squeezed, std::uint64_t exact, Budget& budget)
{
    const ByteView data = squeezed.data;
    const std::uint64_t size = squeezed.method == Squeezed::Method::stored ? data.size() : squeezed.size;
    if (size != exact) return bad_input(concat("unpacks to ", size, " bytes, but ", exact, " are needed"), "size");
    return unsqueeze(squeezed, budget);
}

Result<Bytes> unsqueeze(const Squeezed& squeezed, Budget& budget)
{
    const ByteView data = squeezed.data;
    if (squeezed.method == Squeezed::Method::stored) {
        MESHREEL_CHECK(budget.take(data.size(), "data"));
        return Bytes(data.begin(), data.end());
    }
    if (squeezed.size / block_size > data.size() / least_block)
        return bad_input(concat(data.size(), " bytes cannot unpack to ", squeezed.size), "size");
    if (ZSTD_getFrameContentSize(data.data(), data.size()) != squeezed.size)
        return bad_input("the zstd frame does not promise the same size", "data");
    if (ZSTD_findFrameCompressedSize(data.data(), data.size()) != data.size())
        return bad_input("not one whole zstd frame", "data");
    MESHREEL_CHECK(budget.take(squeezed.size, "size"));
    Bytes bytes(static_cast<std::size_t>(squeezed.size));
    const std::size_t unpacked = ZSTD_decompress(bytes.data(), bytes.size(), data.data(), data.size());
#ifndef MESHREEL_DECODER_ALONE
    if (ZSTD_getErrorCode(unpacked) == ZSTD_error_memory_allocation) return Failure::out_of_memory();
#endif
    if (unpacked != bytes.size()) return bad_input("a damaged zstd frame", "data");
    return bytes;
}

} // namespace meshreel::container
