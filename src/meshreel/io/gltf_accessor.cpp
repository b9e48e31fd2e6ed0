/// Accessors: checked against their buffer views once, then read without fear.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "meshreel/base/text.h"
#include "meshreel/io/gltf_document.h"

namespace meshreel::io {

namespace {

Result<Scalar> component_type_of(const Json& field)
{
    MESHREEL_TRY(const std::uint64_t number, field.integer(1u << 16));
    switch (number) {
    case 5120:
        return Scalar::i8;
    case 5121:
        return Scalar::u8;
    case 5122:
        return Scalar::i16;
    case 5123:
        return Scalar::u16;
    case 5125:
        return Scalar::u32;
    case 5126:
        return Scalar::f32;
    default:
        return field.wrong(concat(number, " is no component type"));
    }
}

Result<std::uint8_t> component_count(const Json& field)
{
    MESHREEL_TRY(const std::string type, field.text_or(""));
    if (type == "SCALAR") return std::uint8_t{1};
    if (type == "VEC2") return std::uint8_t{2};
    if (type == "VEC3") return std::uint8_t{3};
    if (type == "VEC4" || type == "MAT2") return std::uint8_t{4};
    if (type == "MAT3") return std::uint8_t{9};
    if (type == "MAT4") return std::uint8_t{16};
    return field.wrong("is no accessor type");
}

/// Elements of `size` bytes, `stride` apart.
struct Run {
    std::uint64_t count;
    std::size_t size, stride;
};

/// Where a run begins that lies inside the view from an offset on.
Result<const std::uint8_t*> elements(ByteView view, const Json& offset_field, const Run& run)
{
    MESHREEL_TRY(const std::uint64_t offset, offset_field.integer_or(0, view.size() + 1));
    const std::uint64_t room = view.size() - offset;
    if (run.count > 0 && (room < run.size || (run.count - 1) > (room - run.size) / run.stride))
        return offset_field.wrong(
            concat(run.count, " elements reach beyond the buffer view's ", view.size(), " bytes"));
    return view.data() + offset;
}

Status read_dense(const GltfDocument& document, Accessor& found)
{
    const Json reference = found.where.member("bufferView");
    if (!reference) return Ok{};
    MESHREEL_TRY(const std::uint64_t number, reference.integer(document.count("bufferViews")));
    MESHREEL_TRY(const ByteView view, buffer_view(document, number));
    MESHREEL_TRY(const std::uint64_t stride,
                 document.item("bufferViews", number).member("byteStride").integer_or(found.element_size(), 253));
    if (stride < found.element_size())
        return document.item("bufferViews", number).member("byteStride").wrong("is smaller than an element");
    found.stride = stride;
    MESHREEL_TRY(found.data,
                 elements(view, found.where.member("byteOffset"), {found.count, found.element_size(), stride}));
    return Ok{};
}

Status read_sparse(const GltfDocument& document, Accessor& found)
{
    const Json sparse = found.where.member("sparse");
    if (!sparse) return Ok{};
    MESHREEL_TRY(found.sparse_count, sparse.member("count").integer(found.count + 1));
    const Json indices = sparse.member("indices"), values = sparse.member("values");
    MESHREEL_TRY(found.sparse_type, component_type_of(indices.member("componentType")));
    if (found.sparse_type != Scalar::u8 && found.sparse_type != Scalar::u16 && found.sparse_type != Scalar::u32)
        return indices.member("componentType").wrong("is no unsigned type");
    const std::size_t size = scalar_size(found.sparse_type), value_size = found.element_size();
    MESHREEL_TRY(const std::uint64_t index_view, indices.member("bufferView").integer(document.count("bufferViews")));
    MESHREEL_TRY(const ByteView index_bytes, buffer_view(document, index_view));
    MESHREEL_TRY(found.sparse_indices,
                 elements(index_bytes, indices.member("byteOffset"), {found.sparse_count, size, size}));
    MESHREEL_TRY(const std::uint64_t value_view, values.member("bufferView").integer(document.count("bufferViews")));
    MESHREEL_TRY(const ByteView value_bytes, buffer_view(document, value_view));
    MESHREEL_TRY(found.sparse_values,
                 elements(value_bytes, values.member("byteOffset"), {found.sparse_count, value_size, value_size}));
    return Ok{};
}

template <class Number>
Number number_at(const std::uint8_t* bytes)
{
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
}

std::uint32_t unsigned_at(const std::uint8_t* bytes, Scalar type)
{
    if (type == Scalar::u8) return *bytes;
    return type == Scalar::u16 ? number_at<std::uint16_t>(bytes) : number_at<std::uint32_t>(bytes);
}

float float_at(const std::uint8_t* bytes, Scalar type)
{
    switch (type) {
    case Scalar::f32:
        return number_at<float>(bytes);
    case Scalar::i8:
        return static_cast<float>(number_at<std::int8_t>(bytes));
    case Scalar::i16:
        return static_cast<float>(number_at<std::int16_t>(bytes));
    default:
        return static_cast<float>(unsigned_at(bytes, type));
    }
}

/// What a normalised integer is divided by.
double largest_integer(Scalar type)
{
    switch (type) {
    case Scalar::u8:
        return 255;
    case Scalar::i8:
        return 127;
    case Scalar::u16:
        return 65535;
    case Scalar::i16:
        return 32767;
    case Scalar::u32:
        return 4294967295.0;
    default:
        return 1;
    }
}

Status expect_components(const Accessor& accessor, std::uint8_t components)
{
    if (components == 0 || accessor.components == components) return Ok{};
    return accessor.where.member("type").wrong(
        concat(accessor.components, " components where ", components, " are needed"));
}

} // namespace

Status Budget::take(std::uint64_t bytes, const Json& field)
{
    if (bytes > left) return field.wrong(concat("needs ", bytes, " bytes, but the memory limit leaves only ", left));
    left -= bytes;
    return Ok{};
}

Result<Accessor> accessor(const GltfDocument& document, const Json& user)
{
    MESHREEL_TRY(const std::uint64_t number, user.integer(document.count("accessors")));
    Accessor found;
    found.budget = document.budget.get();
    found.where = document.item("accessors", number);
    MESHREEL_TRY(found.type, component_type_of(found.where.member("componentType")));
    MESHREEL_TRY(found.components, component_count(found.where.member("type")));
    MESHREEL_TRY(found.normalized, found.where.member("normalized").truth_or(false));
    MESHREEL_TRY(found.count,
                 found.where.member("count").integer(document.limits.max_memory / found.element_size() + 1));
    MESHREEL_TRY(const std::string type, found.where.member("type").text_or(""));
    if (type[0] == 'M' && scalar_size(found.type) < 4)
        return unsupported("matrices of small integers are not read", found.where.path);
    MESHREEL_CHECK(read_dense(document, found));
    MESHREEL_CHECK(read_sparse(document, found));
    return found;
}

Result<Bytes> packed_values(const Accessor& accessor)
{
    const std::size_t size = accessor.element_size();
    MESHREEL_CHECK(accessor.budget->take(accessor.count * size, accessor.where));
    Bytes packed(accessor.count * size);
    if (accessor.data != nullptr && accessor.stride == size && accessor.count > 0)
        std::memcpy(packed.data(), accessor.data, packed.size());
    else if (accessor.data != nullptr)
        for (std::size_t i = 0; i < accessor.count; ++i)
            std::memcpy(&packed[i * size], accessor.data + i * accessor.stride, size);
    for (std::size_t i = 0; i < accessor.sparse_count; ++i) {
        const std::uint32_t index =
            unsigned_at(accessor.sparse_indices + i * scalar_size(accessor.sparse_type), accessor.sparse_type);
        if (index >= accessor.count)
            return accessor.where.member("sparse").member("indices").wrong(
                concat("index ", index, " is beyond the ", accessor.count, " elements"));
        std::memcpy(&packed[index * size], accessor.sparse_values + i * size, size);
    }
    return packed;
}

Result<Numbers> numbers(const Accessor& accessor, std::uint8_t components)
{
    MESHREEL_CHECK(expect_components(accessor, components));
    MESHREEL_TRY(const Bytes packed, packed_values(accessor));
    const std::size_t size = scalar_size(accessor.type);
    Numbers result;
    result.components = accessor.components;
    result.unit = accessor.normalized ? 1.0 / largest_integer(accessor.type) : 1.0;
    MESHREEL_CHECK(accessor.budget->take(packed.size() / size * sizeof(float), accessor.where));
    accessor.budget->left += packed.size(); // it goes when we return
    result.values.resize(packed.size() / size);
    const float lowest = accessor.normalized ? static_cast<float>(-largest_integer(accessor.type)) : -INFINITY;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float value = float_at(&packed[i * size], accessor.type);
        if (!std::isfinite(value))
            return accessor.where.wrong(concat("element ", i / accessor.components, " is not a finite number"));
        result.values[i] = accessor.type == Scalar::f32 ? value : std::max(value, lowest);
    }
    return result;
}

Result<std::vector<std::uint32_t>> integers(const Accessor& accessor, std::uint8_t components)
{
    MESHREEL_CHECK(expect_components(accessor, components));
    if (accessor.type != Scalar::u8 && accessor.type != Scalar::u16 && accessor.type != Scalar::u32)
        return accessor.where.member("componentType").wrong("is no unsigned type");
    MESHREEL_TRY(const Bytes packed, packed_values(accessor));
    const std::size_t size = scalar_size(accessor.type);
    MESHREEL_CHECK(accessor.budget->take(packed.size() / size * 4, accessor.where));
    accessor.budget->left += packed.size(); // it goes when we return
    std::vector<std::uint32_t> result(packed.size() / size);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = unsigned_at(&packed[i * size], accessor.type);
    return result;
}

} // namespace meshreel::io
