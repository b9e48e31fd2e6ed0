/// Writes UVs, normals, tangents, colours and custom attributes of a vertex set.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_write_attributes.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/gltf_names.h"

namespace meshreel::io {

namespace {

int component_code(Scalar type)
{
    constexpr int codes[] = {5126, 5121, 5123, 5125, 5120, 5122};
    return codes[static_cast<std::size_t>(type)];
}

const char* accessor_type(std::size_t components)
{
    constexpr const char* names[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return components <= 4 ? names[components] : components == 9 ? "MAT3" : components == 16 ? "MAT4" : "";
}

/// May stand in the file as it is. @source glTF 2.0, 3.7.2.1
bool allowed(const std::string& semantic, const Attribute& a)
{
    if (semantic == "NORMAL" || semantic == "TANGENT")
        return a.type == Scalar::f32 && a.components == (semantic == "NORMAL" ? 3 : 4);
    if (semantic[0] == '_')
        return a.type != Scalar::u32 && *accessor_type(a.components) != 0 &&
               (a.components <= 4 || a.type == Scalar::f32);
    const bool number = a.type == Scalar::f32 || (a.normalized && (a.type == Scalar::u8 || a.type == Scalar::u16));
    return number && (semantic.starts_with("TEXCOORD_") ? a.components == 2 : a.components == 3 || a.components == 4);
}

/// Components as floats that glTF wants instead; 0: cannot be had.
std::size_t as_floats(const std::string& semantic, const Attribute& a)
{
    if (semantic[0] == '_' || !(a.type == Scalar::f32 || a.normalized)) return 0;
    const std::size_t wanted = semantic == "NORMAL"                ? 3
                               : semantic == "TANGENT"             ? 4
                               : semantic.starts_with("TEXCOORD_") ? 2
                                                                   : 3;
    return a.components >= wanted ? wanted : 0;
}

/// The place of each vertex's value in the attribute's table; no_value: it has none.
std::vector<std::uint32_t> value_places(const Animation& animation, const Attribute& attribute,
                                        const GltfVertexSet& set)
{
    std::vector<std::uint32_t> places(set.sources.size(), no_value);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (attribute.domain == Domain::corner)
            places[i] = set.corners[i] == no_corner ? no_value : corner_value(attribute, animation, set.corners[i]);
        else
            places[i] = attribute.indices.empty() ? set.sources[i] : attribute.indices[set.sources[i]];
    }
    return places;
}

std::size_t add_raw(GltfBuilder& builder, const Attribute& attribute, std::span<const std::uint32_t> places)
{
    const std::size_t size = scalar_size(attribute.type) * attribute.components, stride = (size + 3) / 4 * 4;
    builder.open_view(stride);
    const std::size_t begin = builder.binary.size();
    builder.binary.resize(begin + places.size() * stride);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] != no_value)
            std::copy_n(&attribute.values[places[i] * size], size, &builder.binary[begin + i * stride]);
    builder.close_view();
    nlohmann::json accessor = {{"bufferView", builder.view()},
                               {"componentType", component_code(attribute.type)},
                               {"count", places.size()},
                               {"type", accessor_type(attribute.components)}};
    if (attribute.normalized) accessor["normalized"] = true;
    return builder.add("accessors", std::move(accessor));
}

/// Normals and tangents must have length 1, and a tangent's w is a sign. Returns whether something had to change.
bool make_unit(std::vector<float>& values, std::size_t components)
{
    constexpr double tolerance = 0.005;
    bool changed = false;
    for (std::size_t i = 0; i < values.size(); i += components) {
        const double x = values[i], y = values[i + 1], z = values[i + 2], length = std::sqrt(x * x + y * y + z * z);
        if (components == 4 && values[i + 3] != 1.0f && values[i + 3] != -1.0f) {
            values[i + 3] = values[i + 3] < 0 ? -1.0f : 1.0f;
            changed = true;
        }
        if (std::abs(length - 1) <= tolerance) continue;
        const bool direction = std::isfinite(length) && length > 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            values[i + axis] = direction ? static_cast<float>(values[i + axis] / length) : axis == 2 ? 1.0f : 0.0f;
        changed = true;
    }
    return changed;
}

/// An attribute on its way into a vertex set.
struct OutColumn {
    const Attribute& attribute;
    std::string semantic;
    std::vector<std::uint32_t> places; ///< of each vertex's value
};

std::size_t add_converted(GltfBuilder& builder, const OutColumn& column, std::size_t components,
                          const SaveOptions& options)
{
    std::vector<float> values;
    for (std::uint32_t place : column.places)
        for (std::size_t c = 0; c < components; ++c)
            values.push_back(place == no_value ? 0.0f : attribute_float(column.attribute, place, c));
    const bool unit = column.semantic == "NORMAL" || column.semantic == "TANGENT";
    if (unit && make_unit(values, components))
        tell(options, concat("some values of the attribute ", column.attribute.name,
                             " were not of length 1 and are scaled to it"));
    builder.open_view(components * 4);
    const std::size_t accessor = builder.add_floats(values, accessor_type(components), false);
    builder.close_view();
    return accessor;
}

/// The accessor of one attribute, or nothing where glTF cannot hold it.
std::optional<std::size_t> add_attribute(GltfBuilder& builder, const OutColumn& column, const SaveOptions& options)
{
    const bool unit = column.semantic == "NORMAL" || column.semantic == "TANGENT";
    if (allowed(column.semantic, column.attribute) && !unit) return add_raw(builder, column.attribute, column.places);
    const std::size_t components = as_floats(column.semantic, column.attribute);
    if (components > 0) return add_converted(builder, column, components, options);
    tell(options, concat("the file cannot hold the attribute ", column.attribute.name, " in its type"));
    return std::nullopt;
}

/// Numbered attributes must begin at 0 without gaps. @source glTF 2.0, 3.7.2.1
void drop_gaps(nlohmann::json& attributes, const SaveOptions& options)
{
    for (const std::string start : {"TEXCOORD_", "COLOR_"}) {
        std::size_t count = 0;
        while (attributes.contains(concat(start, count))) ++count;
        std::vector<std::string> beyond;
        for (const auto& item : attributes.items()) {
            if (!item.key().starts_with(start)) continue;
            bool kept = false;
            for (std::size_t n = 0; n < count; ++n) kept = kept || item.key() == concat(start, n);
            if (!kept) beyond.push_back(item.key());
        }
        for (const std::string& name : beyond) {
            tell(options, concat("a primitive has ", name, " but not those before it; it is left out"));
            attributes.erase(name);
        }
    }
}

} // namespace

nlohmann::json add_attributes(GltfBuilder& builder, const Animation& animation, const GltfVertexSet& set,
                              const SaveOptions& options)
{
    nlohmann::json attributes = nlohmann::json::object();
    for (const Attribute& attribute : animation.appearance.attributes) {
        const std::optional<std::string> semantic = attribute_semantic(attribute.name);
        if (!semantic || attribute.domain == Domain::triangle || attributes.contains(*semantic)) continue;
        const OutColumn column{attribute, *semantic, value_places(animation, attribute, set)};
        const std::vector<std::uint32_t>& places = column.places;
        std::size_t missing = 0, present = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            present += places[i] != no_value;
            missing += places[i] == no_value && set.corners[i] != no_corner;
        }
        if (present == 0) continue;
        if (missing > 0) tell(options, concat(missing, " vertices have no ", attribute.name, "; they get zeros"));
        const std::optional<std::size_t> accessor = add_attribute(builder, column, options);
        if (accessor) attributes[*semantic] = *accessor;
    }
    drop_gaps(attributes, options);
    return attributes;
}

} // namespace meshreel::io
