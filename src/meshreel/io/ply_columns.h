/// Columns of numbers of a PLY element, and the attributes that they are.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "meshreel/base/text.h"
#include "meshreel/io/io.h"
#include "meshreel/io/ply_header.h"

namespace meshreel::io {

/// One scalar property of all rows.
struct PlyColumn {
    std::string name;
    PlyType type = PlyType::f32;
    std::vector<double> values;
};

/// The nearest float32; an infinity where the number is too large.
float to_f32(double value);

/// Takes the columns with these names out, in this order; none where one of them is missing.
std::vector<PlyColumn> take_columns(std::vector<PlyColumn>& columns, std::vector<std::string_view> names);

/// All columns as attributes, one value a row: normals, texture coordinates and colours by their usual names, name_0,
/// name_1, ... of one type as one attribute, all others alone. Warns of what float32 cannot hold.
std::vector<Attribute> attributes_of(std::vector<PlyColumn> columns, Domain domain, const LoadOptions& options);

/// What the texture coordinates of corners are called: the first of uv0, uv1, ... that no row of the file carries.
template <class Carried>
std::string corner_uv_name(const Carried& is_carried)
{
    std::size_t n = 0;
    while (is_carried(concat("uv", n))) ++n;
    return concat("uv", n);
}

} // namespace meshreel::io
