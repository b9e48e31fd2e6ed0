/// What a glTF scene looks like: attributes, materials, names, textures, gathered in the baked order.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/gltf_bake.h"

namespace meshreel::io {

/// What an appearance is gathered from.
struct GltfSource {
    const GltfDocument& document;
    const GltfScene& scene;
    const GltfBody& body;
    const std::function<void(std::string)>& warn; ///< may be empty
};

/// Fills triangles and appearance of an animation whose vertices are those of the body. Triangles of mirrored nodes are
/// turned round, told to `warn`, so that they face outwards in world space.
/// @fails bad_input: an attribute that disagrees with POSITION in its count, a broken image.
Status read_gltf_appearance(const GltfSource& source, Animation& animation);

/// Materials, textures, samplers and images as assets.
Status read_gltf_assets(const GltfDocument& document, Appearance& appearance,
                        const std::function<void(std::string)>& warn);

} // namespace meshreel::io
