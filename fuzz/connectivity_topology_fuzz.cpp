/// Feeds any bytes to the connectivity decoder, and any triangle list made of them through encoder and decoder.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>

#include "meshreel/connectivity/topology.h"

namespace {

using namespace meshreel;
using namespace meshreel::connectivity;

constexpr std::size_t most_triangles = 300;

/// Bytes as a triangle list: small indices, so that every kind of defect occurs.
std::vector<Triangle> list_of(ByteView bytes, std::uint32_t vertex_count)
{
    std::vector<Triangle> triangles(std::min(bytes.size() / 3, most_triangles));
    for (std::size_t i = 0; i < 3 * triangles.size(); ++i) triangles[i / 3][i % 3] = bytes[i] % vertex_count;
    return triangles;
}

void round_trip(ByteView bytes)
{
    if (bytes.size() < 2) return;
    const std::uint32_t vertex_count = 1u + bytes[0];
    const std::vector<Triangle> triangles = list_of(bytes.subspan(2), vertex_count);
    const auto order = static_cast<Order>(bytes[1] % 3);
    const Encoded encoded = encode({vertex_count, triangles, {}}, order);
    const Result<Topology> decoded = decode(encoded.bytes, triangles, {});
    if (!decoded || decoded->triangles != encoded.topology.triangles) std::abort();
    if (order != Order::free && decoded->triangles != triangles) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const ByteView bytes(data, size);
    DecodeLimits limits;
    limits.max_memory = 64 << 20;
    const std::vector<Triangle> base = {{0, 1, 2}, {2, 1, 3}};
    (void)decode(bytes, base, limits);
    round_trip(bytes);
    return 0;
}
