/// Materials, textures and images of a glTF file as assets that travel along unread.
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>
#include <optional>

#include "meshreel/base/text.h"
#include "meshreel/io/gltf_appearance.h"
#include "meshreel/io/gltf_names.h"

namespace meshreel::io {

namespace {

using Warn = std::function<void(std::string)>;

bool begins(const Bytes& bytes, std::size_t at, std::string_view start)
{
    return bytes.size() >= at + start.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes.data()) + at, start.size()) == start;
}

/// By the first bytes.
std::string image_type(const Bytes& bytes)
{
    if (begins(bytes, 0, "\x89PNG")) return "image/png";
    if (begins(bytes, 0, "\xff\xd8\xff")) return "image/jpeg";
    if (begins(bytes, 0, "\xabKTX 20")) return "image/ktx2";
    if (begins(bytes, 0, "RIFF") && begins(bytes, 8, "WEBP")) return "image/webp";
    return begins(bytes, 0, "DDS ") ? "image/vnd-ms.dds" : "application/octet-stream";
}

Result<Bytes> image_bytes(const GltfDocument& document, const Json& image)
{
    if (image.member("bufferView")) {
        MESHREEL_TRY(const std::uint64_t view, image.member("bufferView").integer(document.count("bufferViews")));
        MESHREEL_TRY(const ByteView bytes, buffer_view(document, view));
        MESHREEL_CHECK(document.budget->take(bytes.size(), image));
        return Bytes(bytes.begin(), bytes.end());
    }
    if (!image.member("uri")) return image.wrong("has neither a URI nor a buffer view");
    MESHREEL_TRY(const std::string uri, image.member("uri").text_or(""));
    MESHREEL_TRY(Bytes bytes, read_uri(uri, document.path, document.limits, image.member("uri")));
    MESHREEL_CHECK(document.budget->take(bytes.size(), image));
    return bytes;
}

/// The image as an asset; nothing where it cannot be had, which is told: it keeps its reference.
Result<std::optional<Asset>> image_asset(const GltfDocument& document, std::size_t number, const Warn& warn)
{
    const Json image = document.item("images", number);
    if (!image.value->is_object()) return image.wrong("is no object");
    Result<Bytes> bytes = image_bytes(document, image);
    if (!bytes.ok()) {
        if (bytes.error().code == ErrorCode::bad_input) return std::move(bytes).error();
        if (warn) warn(concat(bytes.error().sentence(), "; the image keeps its reference"));
        return std::optional<Asset>();
    }
    MESHREEL_TRY(std::string type, image.member("mimeType").text_or(image_type(*bytes)));
    return std::optional<Asset>(Asset{gltf_image_name(number), std::move(type), *std::move(bytes)});
}

} // namespace

Status read_gltf_assets(const GltfDocument& document, Appearance& appearance, const Warn& warn)
{
    nlohmann::json carried = nlohmann::json::object();
    const Json asset = document.json().member("asset");
    for (const char* name : {"copyright", "extras"})
        if (asset.member(name)) carried["asset"][name] = *asset.member(name).value;
    for (const char* list : {"materials", "textures", "samplers", "images"})
        if (document.count(list) > 0) carried[list] = *document.json().member(list).value;
    if (carried.empty()) return Ok{};
    MESHREEL_CHECK(document.budget->take(document.file.size(), document.json().member("materials")));
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        if (document.count(list) > 0) carried[list] = *document.json().member(list).value;
    for (std::size_t i = 0; i < document.count("images"); ++i) {
        MESHREEL_TRY(std::optional<Asset> image, image_asset(document, i, warn));
        if (!image) continue;
        carried["images"][i].erase("bufferView");
        carried["images"][i].erase("uri");
        appearance.assets.push_back(*std::move(image));
    }
    const std::string text = carried.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    appearance.assets.insert(appearance.assets.begin(),
                             {gltf_materials_name, gltf_materials_type, Bytes(text.begin(), text.end())});
    return Ok{};
}

} // namespace meshreel::io
