/// Reading PLY: rows of numbers into positions, triangles and attributes.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/ply.h"
#include "meshreel/io/ply_columns.h"
#include "meshreel/io/ply_header.h"
#include "meshreel/io/ply_source.h"
#include "meshreel/io/sequence.h"

namespace meshreel::io {

namespace {

bool names_corners(const PlyProperty& property)
{
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

class PlyReader {
public:
    PlyReader(PlyHeader header, ByteView bytes, const LoadOptions& options)
        : header_(std::move(header)), source_(bytes, header_), options_(options)
    {
    }
    Result<Animation> read();

private:
    Status check_size(const PlyElement& element) const;
    Status read_element(const PlyElement& element);
    Status read_row(const PlyElement& element, std::vector<PlyColumn>& columns);
    Status read_list(const PlyElement& element, const PlyProperty& property);
    Result<std::uint64_t> read_length(const PlyProperty& property);
    Status add_polygon();
    void add_corner_uvs(std::size_t corner_count);
    Status carry_vertices(std::vector<PlyColumn> columns);
    void carry_faces(std::vector<PlyColumn> columns);
    void carry_uvs();
    void keep_names_apart(Attribute& attribute) const;
    void warn() const;

    PlyHeader header_;
    PlySource source_;
    const LoadOptions& options_;
    Animation mesh_;
    std::vector<std::uint32_t> polygon_;
    std::vector<float> polygon_uvs_, uvs_;
    std::vector<std::uint32_t> uv_of_;   ///< [3T] pairs of uvs_
    std::vector<std::uint32_t> face_of_; ///< [T]
    std::uint32_t faces_ = 0;
    bool has_uvs_ = false, has_vertices_ = false;
    std::uint64_t polygons_ = 0, slivers_ = 0;
};

/// A row needs bytes: a count that the rest of the file cannot hold is refused before anything is allocated.
Status PlyReader::check_size(const PlyElement& element) const
{
    const std::size_t smallest = element.smallest_row(header_.coding);
    if (smallest > 0 && element.count > (source_.left() + 1) / smallest)
        return bad_input(concat(element.count, " rows are promised, but ", source_.left(), " bytes are left"),
                         "element " + element.name, source_.place());
    const std::uint64_t row_memory = 8 * element.properties.size() + 40;
    if (smallest > 0 && element.count > options_.limits.max_memory / row_memory)
        return bad_input(concat(element.count, " rows do not fit in the memory limit"), "element " + element.name);
    if (element.name == "vertex") return within(options_.limits, element.count, 0, 1);
    return within(element.count, std::min<std::uint64_t>(options_.limits.max_triangles, no_value),
                  "element " + element.name);
}

Result<std::uint64_t> PlyReader::read_length(const PlyProperty& property)
{
    MESHREEL_TRY(const double length, source_.next(*property.count_type, property.name));
    const std::size_t smallest = header_.coding == PlyCoding::text ? 2 : size_of(property.type);
    if (length < 0 || length > static_cast<double>((source_.left() + 1) / smallest))
        return bad_input(concat("a list of ", static_cast<std::int64_t>(length), " numbers, but ", source_.left(),
                                " bytes are left"),
                         property.name, source_.place());
    return static_cast<std::uint64_t>(length);
}

Status PlyReader::read_list(const PlyElement& element, const PlyProperty& property)
{
    MESHREEL_TRY(const std::uint64_t length, read_length(property));
    const bool face = element.name == "face";
    const bool corners = face && names_corners(property), uvs = face && property.name == "texcoord";
    if (corners && property.type >= PlyType::f32)
        return bad_input("indices are whole numbers", property.name, source_.place());
    for (std::uint64_t i = 0; i < length; ++i) {
        MESHREEL_TRY(const double value, source_.next(property.type, property.name));
        if (uvs) polygon_uvs_.push_back(to_f32(value));
        if (!corners) continue;
        if (value < 0 || value >= mesh_.vertex_count)
            return bad_input(concat("index ", static_cast<std::int64_t>(value), " of face ", faces_,
                                    " is not one of the ", mesh_.vertex_count, " vertices"),
                             property.name, source_.place());
        polygon_.push_back(static_cast<std::uint32_t>(value));
    }
    return Ok{};
}

void PlyReader::add_corner_uvs(std::size_t corner_count)
{
    const auto first = static_cast<std::uint32_t>(uvs_.size() / 2);
    const bool given = polygon_uvs_.size() == 2 * corner_count;
    if (given) uvs_.insert(uvs_.end(), polygon_uvs_.begin(), polygon_uvs_.end());
    for (std::uint32_t i = 2; i < corner_count; ++i)
        for (std::uint32_t corner : {0u, i - 1, i}) uv_of_.push_back(given ? first + corner : no_value);
}

Status PlyReader::add_polygon()
{
    if (!polygon_uvs_.empty() && polygon_uvs_.size() != 2 * polygon_.size())
        return bad_input(concat(polygon_uvs_.size(), " numbers for ", polygon_.size(), " corners of face ", faces_),
                         "texcoord", source_.place());
    if (polygon_.size() < 3) ++slivers_;
    if (polygon_.size() > 3) ++polygons_;
    MESHREEL_CHECK(within(mesh_.triangles.size() + polygon_.size(), options_.limits.max_triangles, "face"));
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
        mesh_.triangles.push_back({polygon_[0], polygon_[i - 1], polygon_[i]});
        face_of_.push_back(faces_);
    }
    if (has_uvs_) add_corner_uvs(polygon_.size());
    ++faces_;
    return Ok{};
}

Status PlyReader::read_row(const PlyElement& element, std::vector<PlyColumn>& columns)
{
    polygon_.clear();
    polygon_uvs_.clear();
    std::size_t column = 0;
    for (const PlyProperty& property : element.properties) {
        if (property.count_type) {
            MESHREEL_CHECK(read_list(element, property));
            continue;
        }
        MESHREEL_TRY(const double value, source_.next(property.type, property.name));
        columns[column++].values.push_back(value);
    }
    return element.name == "face" ? add_polygon() : Status(Ok{});
}

Status PlyReader::read_element(const PlyElement& element)
{
    MESHREEL_CHECK(check_size(element));
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    std::vector<PlyColumn> columns;
    for (const PlyProperty& property : element.properties) {
        if (!property.count_type) columns.push_back({property.name, property.type, {}});
        if (property.count_type && !(faces && (names_corners(property) || property.name == "texcoord")))
            tell(options_, concat("the list ", property.name, " of the element ", element.name, " is left out"));
        has_uvs_ = has_uvs_ || (faces && property.count_type && property.name == "texcoord");
    }
    for (std::uint64_t row = 0; row < element.count && !element.properties.empty(); ++row) {
        MESHREEL_CHECK(read_row(element, columns));
        if (vertices || faces) continue;
        for (PlyColumn& column : columns) column.values.clear();
    }
    if (vertices) return carry_vertices(std::move(columns));
    if (faces)
        carry_faces(std::move(columns));
    else if (element.count > 0)
        tell(options_, concat(element.count, " rows of the element ", element.name, " are left out"));
    return Ok{};
}

Status PlyReader::carry_vertices(std::vector<PlyColumn> columns)
{
    const auto position = take_columns(columns, {"x", "y", "z"});
    if (position.empty()) return bad_input("the vertices have no x, y and z", "element vertex");
    has_vertices_ = true;
    bool exact = true;
    mesh_.positions.resize(mesh_.vertex_count * 3ul);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t v = 0; v < mesh_.vertex_count; ++v) {
            const double value = position[axis].values[v];
            mesh_.positions[v * 3 + axis] = to_f32(value);
            exact = exact && static_cast<double>(mesh_.positions[v * 3 + axis]) == value;
        }
    if (!exact) tell(options_, "positions are rounded to float32");
    for (Attribute& attribute : attributes_of(std::move(columns), Domain::vertex, options_)) {
        keep_names_apart(attribute);
        mesh_.appearance.attributes.push_back(std::move(attribute));
    }
    return Ok{};
}

/// Elsewhere "material" and "group" number the names of an Appearance; a property that does not goes by another name.
void PlyReader::keep_names_apart(Attribute& attribute) const
{
    if (attribute.name != "material" && attribute.name != "group") return;
    const std::size_t names = (attribute.name == "material" ? header_.materials : header_.groups).size();
    bool fits = attribute.domain == Domain::triangle && attribute.type == Scalar::u32 && attribute.components == 1;
    for (std::size_t i = 0; fits && i < attribute.value_count(); ++i) {
        const std::int64_t number = attribute_integer(attribute, i, 0);
        fits = number == no_value || number < static_cast<std::int64_t>(names);
    }
    if (fits) return;
    tell(options_,
         concat("the property ", attribute.name, " does not number names, and is carried as ", attribute.name, "_id"));
    attribute.name += "_id";
}

void PlyReader::carry_faces(std::vector<PlyColumn> columns)
{
    for (Attribute& attribute : attributes_of(std::move(columns), Domain::triangle, options_)) {
        if (mesh_.triangles.empty()) continue;
        if (mesh_.triangles.size() != faces_ || slivers_ > 0) attribute.indices = face_of_;
        keep_names_apart(attribute);
        mesh_.appearance.attributes.push_back(std::move(attribute));
    }
}

void PlyReader::carry_uvs()
{
    if (mesh_.triangles.empty() || uvs_.empty()) return;
    bool in_order = uvs_.size() / 2 == uv_of_.size();
    for (std::size_t i = 0; i < uv_of_.size(); ++i) in_order = in_order && uv_of_[i] == i;
    if (in_order) uv_of_.clear();
    std::string name = corner_uv_name([&](const std::string& uv) { return mesh_.appearance.find(uv) != nullptr; });
    mesh_.appearance.attributes.push_back(
        indexed(float_attribute(std::move(name), Domain::corner, 2, uvs_), std::move(uv_of_)));
}

void PlyReader::warn() const
{
    if (polygons_ > 0)
        tell(options_,
             concat(polygons_,
                    " polygons with more than three corners were cut into triangles, as fans from their first corner"));
    if (slivers_ > 0) tell(options_, concat(slivers_, " faces with fewer than three corners are left out"));
    if (source_.rest() > 0) tell(options_, concat(source_.rest(), " bytes behind the last element are left out"));
}

Result<Animation> PlyReader::read()
{
    for (const PlyElement& element : header_.elements)
        if (element.name == "vertex") {
            MESHREEL_CHECK(within(element.count, std::min<std::uint64_t>(options_.limits.max_vertices, no_value),
                                  "element vertex"));
            mesh_.vertex_count = static_cast<std::uint32_t>(element.count);
        }
    if (mesh_.vertex_count == 0) return bad_input("there is no vertex", "element vertex");
    for (const PlyElement& element : header_.elements) MESHREEL_CHECK(read_element(element));
    carry_uvs();
    warn();
    mesh_.appearance.materials = std::move(header_.materials);
    mesh_.appearance.groups = std::move(header_.groups);
    mesh_.times_s = {0.0};
    return std::move(mesh_);
}

} // namespace

Result<Animation> parse_ply(ByteView bytes, const LoadOptions& options)
{
    MESHREEL_TRY(PlyHeader header, parse_ply_header(bytes));
    return PlyReader(std::move(header), bytes, options).read();
}

Result<Animation> load_ply(const std::string& path, const LoadOptions& options)
{
    return load_sequence(path, options, {parse_ply});
}
Result<std::unique_ptr<FrameSource>> open_ply(const std::string& path, const LoadOptions& options)
{
    return open_sequence(path, options, {parse_ply});
}

} // namespace meshreel::io
