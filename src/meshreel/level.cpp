/// Kept vertices from the codec, triangles from the surface, and what belongs to them.
// SPDX-License-Identifier: MIT
#include "meshreel/level.h"

#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/mesh/coarse_surface.h"

namespace meshreel {

namespace {

Error no_level(std::string message)
{
    return {ErrorCode::usage, std::move(message), "level", {}, {}};
}

/// Values of some elements alone, each value once.
Attribute values_of(const Attribute& attribute, std::span<const std::uint32_t> elements)
{
    constexpr std::uint32_t no_value = 0xffffffff;
    const std::size_t size = scalar_size(attribute.type) * attribute.components;
    std::vector<std::uint32_t> place(attribute.value_count(), no_value);
    Attribute part = attribute;
    part.values.clear();
    part.indices.clear();
    for (const std::uint32_t element : elements) {
        const std::uint32_t old = attribute.indices.empty() ? element : attribute.indices[element];
        if (old == no_value) {
            part.indices.push_back(no_value);
            continue;
        }
        if (place[old] == no_value) {
            place[old] = static_cast<std::uint32_t>(part.value_count());
            const auto value = attribute.values.begin() + static_cast<std::ptrdiff_t>(old * size);
            part.values.insert(part.values.end(), value, value + static_cast<std::ptrdiff_t>(size));
        }
        part.indices.push_back(place[old]);
    }
    if (attribute.indices.empty()) part.indices.clear();
    return part;
}

} // namespace

Status check_level(const codecs::Codec& codec, std::uint32_t level)
{
    if (level == 0 || codec.detail != nullptr) return Ok{};
    return no_level(concat("the codec ", codec.name, " has no levels of detail"));
}

Result<Level> level_of(const codecs::Codec& codec, const codecs::Coded& first_segment,
                       const connectivity::Topology& topology, std::uint32_t level)
{
    MESHREEL_TRY(const codecs::Detail detail, codec.detail(first_segment));
    if (level >= detail.counts.size())
        return no_level(concat("there is no level ", level, "; the coarsest is ", detail.counts.size() - 1));
    std::vector<bool> kept(detail.order.size());
    for (const std::uint32_t v : detail.kept(level)) kept[v] = true;
    Level result;
    for (std::uint32_t v = 0; v < topology.vertex_count; ++v) {
        const std::uint32_t w = topology.surface_of[v];
        if (!kept[w]) continue;
        result.wanted.push_back(w);
        result.vertex_of.push_back(v);
        kept[w] = false; // the first of those that are welded stands for all
    }
    std::vector<Triangle> triangles = topology.triangles;
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) v = topology.surface_of[v];
    CoarseSurface coarse = coarse_surface(triangles, detail.places.view(), result.wanted);
    result.triangles = std::move(coarse.triangles);
    result.triangle_of = std::move(coarse.triangle_of);
    return result;
}

Appearance appearance_of(const Level& level, const Appearance& appearance)
{
    Appearance part;
    part.materials = appearance.materials;
    part.groups = appearance.groups;
    part.assets = appearance.assets;
    for (const Attribute& attribute : appearance.attributes)
        if (attribute.domain != Domain::corner)
            part.attributes.push_back(
                values_of(attribute, attribute.domain == Domain::vertex ? level.vertex_of : level.triangle_of));
    return part;
}

} // namespace meshreel
