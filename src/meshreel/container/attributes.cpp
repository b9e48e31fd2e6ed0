/// Attribute tables: the numbers of a table, and the faces along which they are predicted.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

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

/// Each different entry of a table once, in the order of first occurrence, and where it stands.
struct Distinct {
    std::vector<std::uint32_t> words;  ///< of the different entries
    std::vector<std::uint32_t> places; ///< [value_count]
    std::uint32_t count = 0;
};

Distinct distinct_of(const std::vector<std::uint32_t>& words, std::size_t components)
{
    const auto entry = [&](std::uint32_t i) { return words.begin() + static_cast<std::ptrdiff_t>(i * components); };
    const std::ptrdiff_t width = static_cast<std::ptrdiff_t>(components);
    std::vector<std::uint32_t> sorted(words.size() / components);
    std::iota(sorted.begin(), sorted.end(), 0u);
    const auto compare = [&](std::uint32_t a, std::uint32_t b) {
        const auto [x, y] = std::mismatch(entry(a), entry(a) + width, entry(b));
        return x == entry(a) + width ? a < b : *x < *y;
    };
    std::sort(sorted.begin(), sorted.end(), compare);
    std::vector<std::uint32_t> first(sorted.size()); // of the entries equal to each
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool same = i > 0 && std::equal(entry(sorted[i]), entry(sorted[i]) + width, entry(sorted[i - 1]));
        first[sorted[i]] = same ? first[sorted[i - 1]] : sorted[i];
    }
    Distinct distinct;
    distinct.places.resize(sorted.size());
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        distinct.places[i] = first[i] == i ? distinct.count++ : distinct.places[first[i]];
        if (first[i] == i) distinct.words.insert(distinct.words.end(), entry(i), entry(i) + width);
    }
    return distinct;
}

/// Which values form triangles, if the domain has any. Elements without a value make faces of value 2^32 - 1.
std::vector<Triangle> faces_of(const Attribute& attribute, const MeshShape& mesh)
{
    if (attribute.domain == Domain::triangle) return {};
    const std::vector<std::uint32_t>& indices = attribute.indices;
    std::vector<Triangle> faces(mesh.triangles.size());
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const bool vertex = attribute.domain == Domain::vertex;
            const std::uint32_t element = vertex ? mesh.triangles[t][i] : static_cast<std::uint32_t>(3 * t + i);
            faces[t][i] = indices.empty() ? element : indices[element];
        }
    return faces;
}

/// The faces among distinct values.
void move_faces(std::vector<Triangle>& faces, const std::vector<std::uint32_t>& places)
{
    for (Triangle& face : faces)
        for (std::uint32_t& value : face)
            if (value < places.size()) value = places[value];
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
    error.field = joined(name, ".", error.field);
    return error;
}

void pack_values(AttributeChunk& chunk, const Attribute& attribute, std::vector<Triangle> faces)
{
    const std::vector<std::uint32_t> words = words_of(attribute.values, scalar_size(attribute.type));
    chunk.values = pack_words(words, value_shape(attribute, chunk.value_count), value_context(attribute, faces));
    const Distinct distinct = distinct_of(words, attribute.components);
    if (distinct.count == chunk.value_count) return;
    move_faces(faces, distinct.places);
    WordTable places = pack_words(distinct.places, {chunk.value_count});
    WordTable values =
        pack_words(distinct.words, value_shape(attribute, distinct.count), value_context(attribute, faces));
    constexpr std::size_t fields_more = 8;
    if (places.bytes.data.size() + values.bytes.data.size() + fields_more >= chunk.values.bytes.data.size()) return;
    chunk.repeated = true;
    chunk.distinct_count = distinct.count;
    chunk.places = std::move(places);
    chunk.values = std::move(values);
}

/// The words of all values, from the distinct ones.
Result<std::vector<std::uint32_t>> unpack_values(const AttributeChunk& chunk, std::vector<Triangle> faces,
                                                 Budget& budget)
{
    const WordShape shape = value_shape(chunk.head, chunk.value_count);
    if (!chunk.repeated)
        return under("values", unpack_words(chunk.values, shape, value_context(chunk.head, faces), budget));
    MESHREEL_TRY(const std::vector<std::uint32_t> places,
                 under("places", unpack_words(chunk.places, {chunk.value_count}, {}, budget)));
    for (const std::uint32_t place : places)
        if (place >= chunk.distinct_count)
            return bad_input(concat(place, " is beyond the ", chunk.distinct_count, " values"), "places");
    move_faces(faces, places);
    MESHREEL_TRY(const std::vector<std::uint32_t> distinct,
                 under("values", unpack_words(chunk.values, value_shape(chunk.head, chunk.distinct_count),
                                              value_context(chunk.head, faces), budget)));
    MESHREEL_CHECK(budget.take(shape.words() * 4, "values"));
    std::vector<std::uint32_t> words(static_cast<std::size_t>(shape.words()));
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = distinct[places[i / shape.components] * std::size_t{shape.components} + i % shape.components];
    return words;
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
    pack_values(chunk, attribute, faces_of(attribute, mesh));
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
    MESHREEL_TRY(const std::vector<std::uint32_t> words, unpack_values(chunk, faces_of(attribute, mesh), budget));
    attribute.values = bytes_of(words, scalar_size(attribute.type));
    return attribute;
}

} // namespace meshreel::container
