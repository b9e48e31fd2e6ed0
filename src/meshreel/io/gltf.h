/// glTF 2.0 and GLB, in and out.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/io/io.h"

namespace meshreel::io {

/// Reads a .glb or .gltf: one clip of its default scene, everything in world space. Nodes, skins and morph targets are
/// baked in double at each frame's time and rounded once. Vertices stand in node order, then primitive order.
/// LoadOptions::clip: a clip's name, else its number from 0; LoadOptions::fps: see clip_times (gltf_scene.h).
/// @fails io; bad_input, naming the JSON field; unsupported: a required extension; usage: no such clip.
Result<Animation> load_gltf(const std::string& path, const LoadOptions& options);

/// Writes a .glb, or a .gltf with a .bin beside it. The mesh is the first frame; SaveOptions::morphs says what moves it.
/// @fails io; usage: the file exists; unsupported: times that glTF cannot hold.
Status save_gltf(const Animation& animation, const std::string& path, const SaveOptions& options);

} // namespace meshreel::io
