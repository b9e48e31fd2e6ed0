/// Counts and contents of an animation, as JSON and as lines.
// SPDX-License-Identifier: MIT
#include "cli/figures.h"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace meshreel::cli {

namespace {

Json axis_json(Axis axis)
{
    constexpr std::array<const char*, 4> names{nullptr, "x", "y", "z"};
    const auto index = static_cast<std::size_t>(axis);
    return index == 0 || index >= names.size() ? Json(nullptr) : Json(names[index]);
}

const char* domain_name(Domain domain)
{
    return domain == Domain::vertex ? "vertex" : domain == Domain::corner ? "corner" : "triangle";
}

const char* scalar_name(Scalar type)
{
    constexpr std::array names{"f32", "u8", "u16", "u32", "i8", "i16"};
    return names[static_cast<std::size_t>(type)];
}

Json attribute_json(const Attribute& attribute)
{
    return {{"name", attribute.name},
            {"domain", domain_name(attribute.domain)},
            {"type", scalar_name(attribute.type)},
            {"components", attribute.components},
            {"values", attribute.value_count()}};
}

} // namespace

unsigned long long raw_bytes(const Animation& animation)
{
    return animation.frame_count() * animation.vertex_count * 3 * sizeof(float) +
           animation.triangles.size() * sizeof(Triangle);
}

void add_counts(Json& figures, const Animation& animation)
{
    figures["vertices"] = animation.vertex_count;
    figures["triangles"] = animation.triangles.size();
    figures["frames"] = animation.frame_count();
    figures["start_s"] = animation.times_s.empty() ? 0.0 : animation.times_s.front();
    figures["end_s"] = animation.times_s.empty() ? 0.0 : animation.times_s.back();
}

Json meta_json(const Metadata& meta)
{
    return {{"name", meta.name},
            {"loop", meta.loop},
            {"up", axis_json(meta.up)},
            {"metres_per_unit", meta.metres_per_unit > 0.0 ? Json(meta.metres_per_unit) : Json(nullptr)},
            {"fps", meta.fps > 0.0 ? Json(meta.fps) : Json(nullptr)}};
}

void add_contents(Json& figures, const Animation& animation)
{
    const Appearance& look = animation.appearance;
    figures["attributes"] = Json::array();
    for (const Attribute& attribute : look.attributes) figures["attributes"].push_back(attribute_json(attribute));
    figures["materials"] = look.materials;
    figures["groups"] = look.groups;
    figures["assets"] = Json::array();
    for (const Asset& asset : look.assets)
        figures["assets"].push_back(
            {{"name", asset.name}, {"mime_type", asset.mime_type}, {"bytes", asset.bytes.size()}});
    figures["meta"] = meta_json(animation.meta);
}

std::string counts_text(const Animation& animation)
{
    return fmt::format("{}, {}, {}", counted(animation.vertex_count, "vertex", "vertices"),
                       counted(animation.triangles.size(), "triangle", "triangles"),
                       counted(animation.frame_count(), "frame", "frames"));
}

std::string contents_text(const Animation& animation)
{
    const Appearance& look = animation.appearance;
    const Metadata& meta = animation.meta;
    std::string text;
    if (!meta.name.empty()) text += fmt::format("  name        {}\n", meta.name);
    if (!animation.times_s.empty())
        text +=
            fmt::format("  times       {:.6g} s to {:.6g} s\n", animation.times_s.front(), animation.times_s.back());
    text += meta.fps > 0.0 ? fmt::format("  fps         {:.6g}\n", meta.fps) : "  fps         unknown\n";
    if (meta.loop) text += "  loop        yes\n";
    const Json up = axis_json(meta.up);
    text += fmt::format("  up          {}\n", up.is_null() ? "unknown" : up.get<std::string>());
    text += meta.metres_per_unit > 0.0 ? fmt::format("  unit        {:.6g} m\n", meta.metres_per_unit)
                                       : "  unit        unknown\n";
    text += fmt::format("  diagonal    {:.6g} units (first frame)\n", body_diagonal(animation));
    for (const Attribute& a : look.attributes)
        text += fmt::format("  attribute   {}: {} {} x {} a {}\n", a.name, human_count(a.value_count()),
                            scalar_name(a.type), a.components, domain_name(a.domain));
    if (!look.materials.empty()) text += fmt::format("  materials   {}\n", fmt::join(look.materials, ", "));
    if (!look.groups.empty()) text += fmt::format("  groups      {}\n", fmt::join(look.groups, ", "));
    for (const Asset& asset : look.assets)
        text += fmt::format("  asset       {} ({}, {})\n", asset.name, asset.mime_type,
                            human_bytes(static_cast<double>(asset.bytes.size())));
    return text;
}

} // namespace meshreel::cli
