/// From columns to attributes.
// SPDX-License-Identifier: MIT
#include "meshreel/io/ply_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"

namespace meshreel::io {

namespace {

constexpr std::size_t most_components = 16;

/// The range of all values, and whether all are exact as float32.
struct Extent {
    double low = 0, high = 0;
    bool exact = true;
};

Extent extent_of(const std::vector<PlyColumn>& columns)
{
    Extent extent;
    for (const PlyColumn& column : columns)
        for (double value : column.values) {
            extent.low = std::min(extent.low, value);
            extent.high = std::max(extent.high, value);
            extent.exact = extent.exact && (std::isnan(value) || static_cast<double>(to_f32(value)) == value);
        }
    return extent;
}

/// The type that holds the columns: their own, or the nearest that an attribute has.
Scalar scalar_of(const std::vector<PlyColumn>& columns)
{
    const PlyType type = columns.front().type;
    for (const PlyColumn& column : columns)
        if (column.type != type) return Scalar::f32;
    const Extent extent = type == PlyType::i32 ? extent_of(columns) : Extent{};
    switch (type) {
    case PlyType::i8:
        return Scalar::i8;
    case PlyType::u8:
        return Scalar::u8;
    case PlyType::i16:
        return Scalar::i16;
    case PlyType::u16:
        return Scalar::u16;
    case PlyType::u32:
        return Scalar::u32;
    case PlyType::i32:
        return extent.low >= 0 ? Scalar::u32 : extent.low >= -32768 && extent.high <= 32767 ? Scalar::i16 : Scalar::f32;
    case PlyType::f32:
    case PlyType::f64:
        break;
    }
    return Scalar::f32;
}

void append(Bytes& bytes, double value, Scalar type)
{
    if (type == Scalar::f32) return append_little(bytes, to_f32(value));
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
    if (scalar_size(type) == 4) return append_little(bytes, bits);
    if (scalar_size(type) == 2) return append_little(bytes, static_cast<std::uint16_t>(bits));
    bytes.push_back(static_cast<std::uint8_t>(bits));
}

Attribute attribute_from(std::string name, const std::vector<PlyColumn>& columns, Domain domain,
                         const LoadOptions& options)
{
    Attribute attribute;
    attribute.name = std::move(name);
    attribute.domain = domain;
    attribute.type = scalar_of(columns);
    attribute.components = static_cast<std::uint8_t>(columns.size());
    if (attribute.type == Scalar::f32 && !extent_of(columns).exact)
        tell(options, concat("the property ", attribute.name, " is rounded to float32"));
    const std::size_t rows = columns.front().values.size();
    attribute.values.reserve(rows * columns.size() * scalar_size(attribute.type));
    for (std::size_t row = 0; row < rows; ++row)
        for (const PlyColumn& column : columns) append(attribute.values, column.values[row], attribute.type);
    return attribute;
}

/// "weights_3": the stem and whether the number is `number`.
bool is_part(const PlyColumn& column, std::string_view stem, std::size_t number)
{
    return column.name == concat(stem, "_", number);
}

/// The columns stem_0, stem_1, ... of one type, or the first column alone.
std::vector<PlyColumn> take_next(std::vector<PlyColumn>& columns, std::string& name)
{
    name = columns.front().name;
    std::size_t parts = 1;
    if (name.size() > 2 && name.ends_with("_0")) {
        const std::string stem = name.substr(0, name.size() - 2);
        while (parts < columns.size() && is_part(columns[parts], stem, parts) && columns[parts].type == columns[0].type)
            ++parts;
        if (parts > 1 && parts <= most_components)
            name = stem;
        else
            parts = 1;
    }
    std::vector<PlyColumn> taken(std::make_move_iterator(columns.begin()),
                                 std::make_move_iterator(columns.begin() + parts));
    columns.erase(columns.begin(), columns.begin() + parts);
    return taken;
}

} // namespace

float to_f32(double value)
{
    constexpr double largest = std::numeric_limits<float>::max();
    // Half a step above the largest float32 rounds to infinity; the cast itself must stay in range.
    if (value > largest * (1 + 0x1p-25)) return std::numeric_limits<float>::infinity();
    if (value < -largest * (1 + 0x1p-25)) return -std::numeric_limits<float>::infinity();
    return static_cast<float>(value);
}

std::vector<PlyColumn> take_columns(std::vector<PlyColumn>& columns, std::vector<std::string_view> names)
{
    std::vector<PlyColumn> taken;
    for (std::string_view name : names)
        if (std::ranges::find(columns, name, &PlyColumn::name) == columns.end()) return taken;
    for (std::string_view name : names) {
        const auto place = std::ranges::find(columns, name, &PlyColumn::name);
        taken.push_back(std::move(*place));
        columns.erase(place);
    }
    return taken;
}

std::vector<Attribute> attributes_of(std::vector<PlyColumn> columns, Domain domain, const LoadOptions& options)
{
    std::vector<Attribute> all;
    const auto add = [&](std::string name, std::vector<std::string_view> parts) {
        const std::vector<PlyColumn> taken = take_columns(columns, std::move(parts));
        if (taken.empty()) return false;
        all.push_back(attribute_from(std::move(name), taken, domain, options));
        return true;
    };
    const std::string color = domain == Domain::vertex ? "color0" : "face_color";
    if (domain == Domain::vertex) {
        add("normal", {"nx", "ny", "nz"});
        const bool found = add("uv0", {"s", "t"}) || add("uv0", {"u", "v"}) || add("uv0", {"texture_u", "texture_v"}) ||
                           add("uv0", {"texture_s", "texture_t"});
        static_cast<void>(found);
    }
    if (add(color, {"red", "green", "blue", "alpha"}) || add(color, {"red", "green", "blue"}))
        all.back().normalized = all.back().type != Scalar::f32;
    while (!columns.empty()) {
        std::string name;
        const std::vector<PlyColumn> taken = take_next(columns, name);
        if (std::ranges::find(all, name, &Attribute::name) != all.end())
            tell(options, concat("the property ", name, " has a name that is taken, and is left out"));
        else
            all.push_back(attribute_from(std::move(name), taken, domain, options));
    }
    return all;
}

} // namespace meshreel::io
