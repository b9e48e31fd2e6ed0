/// Feeds any bytes to every codec's decoder, as the payload of a segment of a small surface.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/trace.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

namespace {

void open_coarsest(const codecs::Codec& codec, codecs::Coded coded)
{
    const auto detail = codec.detail(coded);
    if (!detail.ok()) return;
    coded.wanted = detail->kept(detail->counts.size() - 1);
    const auto opened = codecs::open(codec, coded);
    if (!opened.ok() && opened.error().message.empty()) __builtin_trap();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Animation shape = test_shapes::cube_with_hole();
    static const connectivity::Trace trace = connectivity::trace(shape.vertex_count, shape.triangles);
    constexpr std::size_t frame_count = 5;
    for (const codecs::Codec& codec : codecs::all()) {
        Matrix<float> frames(frame_count, 3ul * trace.surface.vertex_count);
        const Status status = codecs::decode(
            codec, {{{data, size}, 0, "SEGM"}, trace.surface, frame_count, {.max_memory = 64u << 20}, Threads{1}},
            frames.view());
        if (!status.ok() && status.error().message.empty()) __builtin_trap();
        if (codec.detail != nullptr)
            open_coarsest(
                codec, {{{data, size}, 0, "SEGM"}, trace.surface, frame_count, {.max_memory = 64u << 20}, Threads{1}});
    }
    return 0;
}
