/// Names on the way between glTF and an Appearance: attributes, groups, assets.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshreel/mesh/animation.h"

namespace meshreel::io {

/// The asset with the JSON of asset, materials, textures, samplers, images; images[i] travels as gltf_image_name(i).
constexpr const char* gltf_materials_name = "gltf/materials";
constexpr const char* gltf_materials_type = "model/gltf+json;materials";
std::string gltf_image_name(std::size_t i); ///< "gltf/images/3"

/// "TEXCOORD_1" -> "uv1", "NORMAL" -> "normal", "COLOR_0" -> "color0", "_TEMPERATURE" stays. Nothing: not carried.
std::optional<std::string> attribute_name(const std::string& semantic);
/// The way back, also for the variants of gltf_variant. Nothing: glTF has no such attribute.
std::optional<std::string> attribute_semantic(const std::string& name);

/// Where primitives hold the same attribute in several types, all but the first type are told apart by a suffix:
/// "color0" as four normalised bytes -> "color0|u8nx4".
std::string variant_name(const Attribute& attribute);

/// A group is "node/mesh#primitive", each name percent-escaped; "node@2/..." is the second node of that name.
struct GltfGroup {
    std::string node;
    std::size_t instance = 1; ///< counts the nodes of one name
    std::string mesh;
    std::size_t primitive = 0;

    std::string name() const;
};

/// Any group name; one that is no such path is the name of a node and its mesh.
GltfGroup parse_group(const std::string& name);

} // namespace meshreel::io
