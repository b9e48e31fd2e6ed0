/// Copies an animation's arrays one after the other, positions excepted, which are fetched where they are.
// SPDX-License-Identifier: MIT
#include "cli/web/sheet.h"

#include <algorithm>
#include <array>
#include <bit>

#include "cli/report.h"
#include "meshreel/mesh/weld.h"

namespace meshreel::cli {

namespace {

static_assert(std::endian::native == std::endian::little, "the page reads numbers as this machine has them");

template <class Number>
ByteView sheet_bytes(const std::vector<Number>& values)
{
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(Number)};
}

void append_padded(Bytes& all, ByteView bytes, std::uint8_t filling = 0)
{
    all.insert(all.end(), bytes.begin(), bytes.end());
    all.resize((all.size() + 3) / 4 * 4, filling);
}

Json sheet_attribute(const Attribute& attribute)
{
    constexpr std::array domains{"vertex", "corner", "triangle"};
    constexpr std::array types{"f32", "u8", "u16", "u32", "i8", "i16"};
    return {{"name", attribute.name},
            {"domain", domains[static_cast<std::size_t>(attribute.domain)]},
            {"type", types[static_cast<std::size_t>(attribute.type)]},
            {"components", attribute.components},
            {"normalized", attribute.normalized},
            {"bytes", attribute.values.size()},
            {"indices", attribute.indices.size()}};
}

/// As js/src/decoder.d.ts has a ReelHead, with the sizes of the arrays instead of the arrays.
Json sheet_head(const Animation& animation, std::uint32_t rows)
{
    constexpr std::array axes{"unknown", "x", "y", "z"};
    Json attributes = Json::array();
    for (const Attribute& attribute : animation.appearance.attributes) attributes.push_back(sheet_attribute(attribute));
    return {{"vertexCount", animation.vertex_count},
            {"codedVertexCount", rows},
            {"triangleCount", animation.triangles.size()},
            {"frameCount", animation.frame_count()},
            {"name", animation.meta.name},
            {"loop", animation.meta.loop},
            {"up", axes[static_cast<std::size_t>(animation.meta.up)]},
            {"metresPerUnit", animation.meta.metres_per_unit},
            {"fps", animation.meta.fps},
            {"times", animation.times_s},
            {"materials", animation.appearance.materials},
            {"groups", animation.appearance.groups},
            {"attributes", attributes}};
}

} // namespace

Sheet::Sheet(const Animation& animation, Threads threads) : animation_(animation)
{
    const Weld welded = weld(animation, threads);
    const std::string head =
        sheet_head(animation, welded.unique_count()).dump(-1, ' ', false, Json::error_handler_t::replace);
    const auto size = static_cast<std::uint32_t>(head.size());
    for (int shift = 0; shift < 32; shift += 8) beginning_.push_back(static_cast<std::uint8_t>(size >> shift));
    append_padded(beginning_, Bytes(head.begin(), head.end()), ' ');
    append_padded(beginning_, sheet_bytes(animation.triangles));
    append_padded(beginning_, sheet_bytes(welded.unique_of));
    for (const Attribute& attribute : animation.appearance.attributes) {
        append_padded(beginning_, attribute.values);
        append_padded(beginning_, sheet_bytes(attribute.indices));
    }
}

ByteView Sheet::positions() const
{
    return sheet_bytes(animation_.positions);
}

Result<Bytes> Sheet::fetch(std::uint64_t offset, std::size_t count)
{
    const ByteView parts[] = {beginning_, positions()};
    Bytes bytes;
    bytes.reserve(count);
    for (const ByteView part : parts) {
        const auto from = static_cast<std::size_t>(std::min<std::uint64_t>(offset, part.size()));
        const std::size_t taken = std::min(count - bytes.size(), part.size() - from);
        bytes.insert(bytes.end(), part.begin() + from, part.begin() + from + taken);
        offset -= std::min<std::uint64_t>(offset, part.size());
    }
    return bytes;
}

} // namespace meshreel::cli
