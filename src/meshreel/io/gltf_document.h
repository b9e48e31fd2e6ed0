/// A glTF file taken apart: its JSON, its buffers, its accessors' numbers.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "meshreel/io/gltf_json.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::io {

/// What may still be allocated for one file.
struct Budget {
    std::uint64_t left = 0; ///< bytes

    /// @fails bad_input: there is not enough left.
    Status take(std::uint64_t bytes, const Json& field);
};

/// The file as read. Views into it live as long as it does.
struct GltfDocument {
    std::unique_ptr<const nlohmann::json> root;
    std::string path;
    Bytes file;
    std::vector<Bytes> loaded; ///< buffers from data URIs and neighbouring files; empty where the file itself holds it
    std::vector<ByteView> buffers; ///< one a buffer, exactly its byteLength
    DecodeLimits limits;
    std::unique_ptr<Budget> budget; ///< spent by whoever reads, also from a constant document

    GltfDocument();
    GltfDocument(GltfDocument&&) noexcept;
    ~GltfDocument();

    Json json() const { return {root.get(), {}}; }
    /// accessors[i], meshes[i] ...; absent beyond the end.
    Json item(const char* list, std::uint64_t i) const { return json().member(list).element(i); }
    std::uint64_t count(const char* list) const { return json().member(list).size(); }
};

/// Reads a .glb or .gltf with all its buffers. @fails io; bad_input; unsupported: a required extension is not known.
Result<GltfDocument> read_gltf_document(const std::string& path, const DecodeLimits& limits);

/// The bytes that a URI stands for: a data URI, or a file in the folder of `beside` or below it. `field` for errors.
/// @fails bad_input: not base64, or a path that leaves the folder; unsupported: a remote URI; io: cannot be read.
Result<Bytes> read_uri(const std::string& uri, const std::string& beside, const DecodeLimits& limits,
                       const Json& field);

/// The bytes of bufferViews[i].
Result<ByteView> buffer_view(const GltfDocument& document, std::uint64_t i);

/// An accessor that was checked against its buffers: every element can be read.
struct Accessor {
    std::uint64_t count = 0;
    Scalar type = Scalar::f32;
    std::uint8_t components = 1; ///< 1 .. 16
    bool normalized = false;
    const std::uint8_t* data = nullptr; ///< null: all zero
    std::size_t stride = 0;             ///< bytes from element to element
    std::uint64_t sparse_count = 0;     ///< elements that are replaced
    Scalar sparse_type = Scalar::u32;
    const std::uint8_t* sparse_indices = nullptr;
    const std::uint8_t* sparse_values = nullptr;
    Json where;
    Budget* budget = nullptr;

    std::size_t element_size() const { return scalar_size(type) * components; }
};

/// accessors[i]. `user` names the field that holds i, for errors.
Result<Accessor> accessor(const GltfDocument& document, const Json& user);

/// Its elements, tightly packed, sparse replacements made. @fails bad_input: a sparse index out of range, too large.
Result<Bytes> packed_values(const Accessor& accessor);

/// Its elements as numbers: value i stands for numbers[i] * unit. Exact for every type but u32.
struct Numbers {
    std::vector<float> values; ///< [count x components]
    double unit = 1.0;         ///< 1 / 255, ... for normalised integers
    std::uint8_t components = 1;

    double operator()(std::size_t element, std::size_t component) const
    {
        return static_cast<double>(values[element * components + component]) * unit;
    }
};

/// @fails bad_input: another number of components than `components` (0: any), an infinity or NaN.
Result<Numbers> numbers(const Accessor& accessor, std::uint8_t components);

/// Its elements as whole numbers. @fails bad_input: a float accessor.
Result<std::vector<std::uint32_t>> integers(const Accessor& accessor, std::uint8_t components);

} // namespace meshreel::io
