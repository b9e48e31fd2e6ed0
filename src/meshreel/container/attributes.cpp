/// Attribute tables: the numbers of a table, and the faces along which they are predicted.
// SPDX-License-Identifier: MIT
#include "meshreel/base/text.h"
#include "meshreel/container/package.h"

namespace meshreel::container {

namespace {

std::uint64_t element_count(Domain domain, const MeshShape& mesh)
{
    if (domain == Domain::vertex) return mesh.vertex_count;
    return mesh.triangles.size() * (domain == Domain::corner ? 3ull : 1ull);
}

std::vector<std::uint32_t> words_of(const Bytes& bytes, std::size_t width)
{
    std::vector<std::uint32_t> words(bytes.size() / width);
    for (std::size_t i = 0; i < words.size(); ++i)
        for (std::size_t b = 0; b < width; ++b) words[i] |= static_cast<std::uint32_t>(bytes[i * width + b]) << (8 * b);
    return words;
}

Bytes bytes_of(const std::vector<std::uint32_t>& words, std::size_t width)
{
    Bytes bytes(words.size() * width);
    for (std::size_t i = 0; i < words.size(); ++i)
        for (std::size_t b = 0; b < width; ++b) bytes[i * width + b] = static_cast<std::uint8_t>(words[i] >> (8 * b));
    return bytes;
}

/// Which values form triangles, if the domain has any.
std::vector<Triangle> faces_of(Domain domain, const std::vector<std::uint32_t>& indices, const MeshShape& mesh)
{
    if (domain == Domain::triangle) return {};
    std::vector<Triangle> faces(mesh.triangles.size());
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t element =
                domain == Domain::vertex ? mesh.triangles[t][i] : static_cast<std::uint32_t>(3 * t + i);
            faces[t][i] = indices.empty() ? element : indices[element];
        }
    return faces;
}

WordShape value_shape(const Attribute& head, std::uint64_t count)
{
    return {count, head.components, static_cast<std::uint32_t>(scalar_size(head.type))};
}

WordContext value_context(const Attribute& head, const std::vector<Triangle>& faces)
{
    return {faces.empty() ? nullptr : &faces, nullptr, 0, head.type == Scalar::f32};
}

WordContext index_context(Domain domain, const MeshShape& mesh)
{
    return {nullptr, domain == Domain::corner ? &mesh.triangles : nullptr, mesh.vertex_count, false};
}

Status check_indices(const std::vector<std::uint32_t>& indices, std::uint64_t value_count)
{
    for (const std::uint32_t index : indices)
        if (index != 0xffffffffu && index >= value_count)
            return bad_input(concat("index ", index, " is beyond the ", value_count, " values"), "indices");
    return Ok{};
}

template <class T>
Result<T> under(std::string_view name, Result<T> result)
{
    if (result.ok()) return result;
    Error error = std::move(result).error();
    error.field = concat(name, ".", error.field);
    return error;
}

} // namespace

AttributeChunk pack_attribute(const Attribute& attribute, const MeshShape& mesh)
{
    AttributeChunk chunk;
    chunk.head = {attribute.name, attribute.domain, attribute.type, attribute.components, attribute.normalized, {}, {}};
    chunk.value_count = attribute.value_count();
    chunk.indexed = !attribute.indices.empty();
    if (chunk.indexed)
        chunk.indices =
            pack_words(attribute.indices, {attribute.indices.size()}, index_context(attribute.domain, mesh));
    const std::vector<Triangle> faces = faces_of(attribute.domain, attribute.indices, mesh);
    const std::vector<std::uint32_t> words = words_of(attribute.values, scalar_size(attribute.type));
    chunk.values = pack_words(words, value_shape(attribute, chunk.value_count), value_context(attribute, faces));
    return chunk;
}

Result<Attribute> unpack_attribute(const AttributeChunk& chunk, const MeshShape& mesh, Budget& budget)
{
    Attribute attribute = chunk.head;
    const std::uint64_t elements = element_count(attribute.domain, mesh);
    if (chunk.indexed) {
        MESHREEL_TRY(attribute.indices, under("indices", unpack_words(chunk.indices, {elements},
                                                                      index_context(attribute.domain, mesh), budget)));
        MESHREEL_CHECK(check_indices(attribute.indices, chunk.value_count));
    } else if (chunk.value_count != elements) {
        return bad_input(concat(chunk.value_count, " values for ", elements, " elements"), "value_count");
    }
    MESHREEL_CHECK(budget.take(mesh.triangles.size() * 12ull, "values"));
    const std::vector<Triangle> faces = faces_of(attribute.domain, attribute.indices, mesh);
    MESHREEL_TRY(const std::vector<std::uint32_t> words,
                 under("values", unpack_words(chunk.values, value_shape(attribute, chunk.value_count),
                                              value_context(attribute, faces), budget)));
    attribute.values = bytes_of(words, scalar_size(attribute.type));
    return attribute;
}

} // namespace meshreel::container
