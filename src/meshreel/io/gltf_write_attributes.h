/// Writes the attributes of a vertex set into a glTF document.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/gltf_build.h"
#include "meshreel/io/gltf_layout.h"

namespace meshreel::io {

/// The "attributes" of a primitive, without POSITION: each attribute that glTF has a name for and of which the set has
/// values, in its own type where glTF allows it, else as floats. What cannot be written is told to `options.warn`.
nlohmann::json add_attributes(GltfBuilder& builder, const Animation& animation, const GltfVertexSet& set,
                              const SaveOptions& options);

} // namespace meshreel::io
