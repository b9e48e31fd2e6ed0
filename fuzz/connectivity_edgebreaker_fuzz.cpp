/// Any bytes as a CLERS string with merges: an error, or triangles that are conquered again to as many symbols.
// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "meshreel/connectivity/edgebreaker.h"

using namespace meshreel;
using namespace meshreel::connectivity;

namespace {

constexpr std::size_t bytes_a_merge = 4;

/// The first byte says how many merges there are and how many components; a symbol takes a byte.
ClersString string_of(ByteView bytes)
{
    ClersString string;
    const std::size_t merges = std::min<std::size_t>(bytes[0] % 8, (bytes.size() - 1) / bytes_a_merge);
    std::uint32_t symbol = 0;
    for (std::size_t i = 0; i < merges; ++i) {
        const ByteView merge = bytes.subspan(1 + bytes_a_merge * i, bytes_a_merge);
        symbol += 1u + merge[0];
        string.merges.push_back({symbol, merge[1], merge[2], merge[3]});
    }
    for (const std::uint8_t byte : bytes.subspan(1 + bytes_a_merge * merges))
        string.symbols.push_back(static_cast<Clers>(byte % 5));
    string.triangle_count = static_cast<std::uint32_t>(string.symbols.size()) + bytes[0] / 8u;
    return string;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0) return 0;
    const ClersString string = string_of({data, size});
    const auto triangles = rebuild(string);
    if (!triangles.ok()) {
        if (triangles.error().message.empty()) std::abort();
        return 0;
    }
    if (triangles->size() != string.triangle_count) std::abort();
    for (const Triangle& triangle : *triangles)
        for (const std::uint32_t v : triangle)
            if (v >= 3 * triangles->size()) std::abort();
    return 0;
}
