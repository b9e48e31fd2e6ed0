/// Any bytes as a .reel file: taken apart, explained, and everything in it read that no codec is needed for.
// SPDX-License-Identifier: MIT
#include "meshreel/container/explain.h"
#include "meshreel/container/package.h"

namespace {

using namespace meshreel;
using namespace meshreel::container;

constexpr DecodeLimits limits{
    .max_vertices = 1 << 16, .max_triangles = 1 << 16, .max_frames = 1 << 16, .max_memory = 64 << 20};

/// A file whose checksums are right, so that the fuzzer gets past them: chunks as [type][length][payload]...
Bytes file_of(ByteView data)
{
    constexpr Tag types[] = {type::head, type::time, type::meta, type::conn,       type::matl,      type::grup,
                             type::attr, type::aset, type::segm, make_tag("news"), make_tag("NEWS")};
    MemoryWriter file;
    while (data.size() >= 3) {
        const Tag type = types[data[0] % std::size(types)];
        const std::size_t size =
            std::min<std::size_t>(static_cast<std::size_t>(load<2>(data.data() + 1)), data.size() - 3);
        file.add(type, data.subspan(3, size));
        data = data.subspan(3 + size);
    }
    return std::move(file).finish();
}

void read_all(ByteView bytes)
{
    const auto file = StreamReader::open(bytes, limits);
    if (!file.ok()) {
        if (file.error().message.empty()) __builtin_trap();
        return;
    }
    (void)explain(*file).ok();
    const auto header = read_header(*file);
    if (!header.ok()) return;
    Budget budget(limits.max_memory);
    (void)read_times(*file, *header, budget).ok();
    (void)read_metadata(*file).ok();
    (void)read_segments(*file, *header).ok();
    std::vector<Triangle> triangles(header->triangle_count); // any triangles do
    for (std::size_t c = 0; c < triangles.size() * 3; ++c)
        triangles[c / 3][c % 3] = static_cast<std::uint32_t>((c / 3 + c % 3 * c % 5) % header->vertex_count);
    (void)read_appearance(*file, {header->vertex_count, triangles}, budget).ok();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    read_all({data, size});
    read_all(file_of({data, size}));
    return 0;
}
