/// Tables of attributes, in memory and as numbers.
// SPDX-License-Identifier: MIT
#include "meshreel/io/attributes.h"

#include <algorithm>
#include <cstring>

#include "meshreel/base/text.h"
#include "meshreel/io/frames.h"

namespace meshreel::io {

namespace {

template <class Number>
void append_bits(Bytes& bytes, Number bits)
{
    for (std::size_t i = 0; i < sizeof bits; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
}

std::uint32_t bits_at(const Attribute& attribute, std::size_t value, std::size_t component)
{
    const std::size_t size = scalar_size(attribute.type);
    const std::uint8_t* at = attribute.values.data() + (value * attribute.components + component) * size;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) bits |= std::uint32_t(at[i]) << (8 * i);
    return bits;
}

/// What a normalized integer is divided by.
float full_scale(Scalar type)
{
    switch (type) {
    case Scalar::u8:
        return 255.0f;
    case Scalar::i8:
        return 127.0f;
    case Scalar::u16:
        return 65535.0f;
    case Scalar::i16:
        return 32767.0f;
    case Scalar::u32:
        return 4294967295.0f;
    case Scalar::f32:
        break;
    }
    return 1.0f;
}

} // namespace

void append_little(Bytes& bytes, float number)
{
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    append_bits(bytes, bits);
}
void append_little(Bytes& bytes, std::uint32_t number)
{
    append_bits(bytes, number);
}
void append_little(Bytes& bytes, std::uint16_t number)
{
    append_bits(bytes, number);
}

Attribute indexed(Attribute attribute, std::vector<std::uint32_t> indices)
{
    attribute.indices = std::move(indices);
    return attribute;
}

Attribute float_attribute(std::string name, Domain domain, std::uint8_t components, std::span<const float> values)
{
    Attribute attribute{std::move(name), domain, Scalar::f32, components, false, {}, {}};
    attribute.values.reserve(values.size() * 4);
    for (float value : values) append_little(attribute.values, value);
    return attribute;
}

Attribute triangle_numbers(std::string name, std::span<const std::uint32_t> numbers)
{
    Attribute attribute{std::move(name), Domain::triangle, Scalar::u32, 1, false, {}, {}};
    if (std::ranges::find(numbers, no_value) == numbers.end()) {
        attribute.values.reserve(numbers.size() * 4);
        for (std::uint32_t number : numbers) append_little(attribute.values, number);
        return attribute;
    }
    std::uint32_t count = 0;
    for (std::uint32_t number : numbers)
        if (number != no_value) count = std::max(count, number + 1);
    for (std::uint32_t number = 0; number < count; ++number) append_little(attribute.values, number);
    attribute.indices.assign(numbers.begin(), numbers.end());
    return attribute;
}

std::uint32_t triangle_number(const Attribute& attribute, std::size_t triangle)
{
    const std::size_t value = attribute.indices.empty() ? triangle : attribute.indices[triangle];
    return value == no_value ? no_value : bits_at(attribute, value, 0);
}

std::uint32_t corner_value(const Attribute& attribute, const Animation& animation, std::size_t corner)
{
    const std::size_t element =
        attribute.domain == Domain::corner ? corner : animation.triangles[corner / 3][corner % 3];
    return attribute.indices.empty() ? static_cast<std::uint32_t>(element) : attribute.indices[element];
}

std::optional<std::vector<std::uint32_t>> vertex_values(const Attribute& attribute, const Animation& animation)
{
    std::vector<std::uint32_t> values(animation.vertex_count, no_value);
    if (attribute.domain == Domain::triangle) return std::nullopt;
    if (attribute.domain == Domain::vertex) {
        for (std::uint32_t v = 0; v < animation.vertex_count; ++v)
            values[v] = attribute.indices.empty() ? v : attribute.indices[v];
        return values;
    }
    const std::size_t size = scalar_size(attribute.type) * attribute.components;
    for (std::size_t corner = 0; corner < animation.triangles.size() * 3; ++corner) {
        std::uint32_t& known = values[animation.triangles[corner / 3][corner % 3]];
        const std::uint32_t value = corner_value(attribute, animation, corner);
        if (known == no_value) known = value;
        const auto at = [&](std::uint32_t i) { return attribute.values.data() + i * size; };
        if (value == no_value ? known != no_value : std::memcmp(at(known), at(value), size) != 0) return std::nullopt;
    }
    return values;
}

std::int64_t attribute_integer(const Attribute& attribute, std::size_t value, std::size_t component)
{
    const std::uint32_t bits = bits_at(attribute, value, component);
    if (attribute.type == Scalar::i8) return static_cast<std::int8_t>(bits);
    if (attribute.type == Scalar::i16) return static_cast<std::int16_t>(bits);
    return bits;
}

float attribute_float(const Attribute& attribute, std::size_t value, std::size_t component)
{
    if (attribute.type == Scalar::f32) {
        const std::uint32_t bits = bits_at(attribute, value, component);
        float number = 0;
        std::memcpy(&number, &bits, sizeof number);
        return number;
    }
    const auto number = static_cast<float>(attribute_integer(attribute, value, component));
    return attribute.normalized ? std::max(number / full_scale(attribute.type), -1.0f) : number;
}

void tell_left_out(const Animation& animation, std::span<const std::string_view> held, const SaveOptions& options)
{
    for (const Attribute& attribute : animation.appearance.attributes)
        if (std::ranges::find(held, attribute.name) == held.end())
            tell(options, concat("the file cannot hold the attribute ", attribute.name));
}

} // namespace meshreel::io
