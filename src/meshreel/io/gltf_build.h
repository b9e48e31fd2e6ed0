/// A glTF document under construction: JSON and one binary buffer.
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "meshreel/io/io.h"

namespace meshreel::io {

/// Grows a document; what is added is referred to by the number that comes back.
class GltfBuilder {
public:
    nlohmann::json root = nlohmann::json::object();
    Bytes binary;

    /// Appends to a list: add("nodes", ...) -> its number.
    std::size_t add(const char* list, nlohmann::json item);

    /// Opens a buffer view at a multiple of 4; what is appended to `binary` until close_view() is its content.
    /// stride: bytes from vertex to vertex; 0: no vertices.
    std::size_t open_view(std::size_t stride, bool indices = false);
    void close_view();

    /// An accessor of floats at the end of the open view: appends them. Bounds are stated where asked for.
    std::size_t add_floats(std::span<const float> values, const char* type, bool bounds);

    /// The number of the last view.
    std::size_t view() const { return root.at("bufferViews").size() - 1; }

private:
    std::size_t opened_ = 0; ///< where the open view begins
};

/// Materials, textures, samplers, images and credits of an appearance. Where the carried JSON does not fit the
/// materials' names, materials with just those names are written and `options.warn` is told.
void add_materials(GltfBuilder& builder, const Animation& animation, const SaveOptions& options);

} // namespace meshreel::io
