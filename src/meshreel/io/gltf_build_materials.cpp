/// Puts materials, textures and images that travelled along back into a glTF document.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "meshreel/base/text.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/gltf_build.h"
#include "meshreel/io/gltf_json.h"
#include "meshreel/io/gltf_names.h"

namespace meshreel::io {

namespace {

using nlohmann::json;

constexpr const char* carried_lists[] = {"materials", "textures", "samplers", "images"};

const Asset* find_asset(const Appearance& appearance, const std::string& name)
{
    const auto found = std::find_if(appearance.assets.begin(), appearance.assets.end(),
                                    [&](const Asset& asset) { return asset.name == name; });
    return found == appearance.assets.end() ? nullptr : &*found;
}

/// Lists of objects, and as many materials as there are names.
bool fits(const json& carried, const Appearance& appearance)
{
    for (const char* list : carried_lists) {
        if (!carried.contains(list)) continue;
        const json& items = carried[list];
        if (!items.is_array() ||
            !std::all_of(items.begin(), items.end(), [](const json& item) { return item.is_object(); }))
            return false;
    }
    const std::size_t count = carried.contains("materials") ? carried["materials"].size() : 0;
    return count == appearance.materials.size();
}

/// The JSON that travelled along, or nothing.
json carried_json(const Appearance& appearance, const SaveOptions& options)
{
    const Asset* asset = find_asset(appearance, gltf_materials_name);
    if (asset == nullptr) return json::object();
    const std::string_view text(reinterpret_cast<const char*>(asset->bytes.data()), asset->bytes.size());
    Result<json> parsed = parse_json(text, {});
    if (parsed.ok() && fits(*parsed, appearance)) return *std::move(parsed);
    tell(options, "the glTF materials that came along do not fit the materials' names; only the names are written");
    return json::object();
}

/// Every extension that is spoken of inside.
void collect_extensions(const json& value, std::set<std::string>& names)
{
    for (const auto& item : value.items()) {
        if (!item.value().is_structured()) continue;
        if (value.is_object() && item.key() == "extensions")
            for (const auto& extension : item.value().items()) names.insert(extension.key());
        collect_extensions(item.value(), names);
    }
}

void add_images(GltfBuilder& builder, const Appearance& appearance, json& images, const SaveOptions& options)
{
    for (std::size_t i = 0; i < images.size(); ++i) {
        const Asset* asset = find_asset(appearance, gltf_image_name(i));
        if (asset == nullptr) {
            if (!images[i].contains("uri"))
                tell(options, concat("image ", i, " did not come along; its textures will be missing"));
            continue;
        }
        images[i]["bufferView"] = builder.open_view(0);
        images[i]["mimeType"] = asset->mime_type;
        builder.binary.insert(builder.binary.end(), asset->bytes.begin(), asset->bytes.end());
        builder.close_view();
    }
}

/// Of a list of names, those among `used`.
json chosen(const json& carried, const char* list, const std::set<std::string>& used)
{
    json names = json::array();
    if (carried.contains(list) && carried[list].is_array())
        for (const json& name : carried[list])
            if (name.is_string() && used.count(name.get<std::string>()) > 0) names.push_back(name);
    return names;
}

} // namespace

void add_materials(GltfBuilder& builder, const Animation& animation, const SaveOptions& options)
{
    json carried = carried_json(animation.appearance, options);
    if (carried.contains("asset") && carried["asset"].is_object())
        for (const char* name : {"copyright", "extras"})
            if (carried["asset"].contains(name)) builder.root["asset"][name] = carried["asset"][name];
    if (carried.contains("images")) add_images(builder, animation.appearance, carried["images"], options);
    std::set<std::string> used;
    for (const char* list : carried_lists) {
        if (!carried.contains(list) || carried[list].empty()) continue;
        collect_extensions(carried[list], used);
        builder.root[list] = std::move(carried[list]);
    }
    if (!builder.root.contains("materials"))
        for (const std::string& name : animation.appearance.materials) builder.add("materials", {{"name", name}});
    if (used.empty()) return;
    builder.root["extensionsUsed"] = used;
    const json required = chosen(carried, "extensionsRequired", used);
    if (!required.empty()) builder.root["extensionsRequired"] = required;
}

} // namespace meshreel::io
