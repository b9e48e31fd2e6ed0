/// Writing PLY: a header from the attributes, then rows.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/ply.h"
#include "meshreel/io/ply_columns.h"
#include "meshreel/io/ply_header.h"
#include "meshreel/io/sequence.h"
#include "meshreel/io/text_write.h"

namespace meshreel::io {

namespace {

/// An attribute as scalar properties of a row.
struct PlyValues {
    const Attribute* attribute;
    std::vector<std::string> names;   ///< one a component
    std::vector<std::uint32_t> value; ///< of each row, a place in the table or no_value
};

/// An attribute's name as a word of a header.
std::string stem_of(const Attribute& attribute)
{
    std::string stem = attribute.name.empty() ? "unnamed" : attribute.name;
    std::ranges::replace_if(
        stem, [](unsigned char c) { return c <= ' ' || c == 127 || c == '#'; }, '_');
    return stem;
}

/// stem_0, stem_1, ..., which are read as one attribute.
std::vector<std::string> numbered(const std::string& stem, std::size_t components)
{
    if (components == 1) return {stem};
    std::vector<std::string> names;
    for (std::size_t c = 0; c < components; ++c) names.push_back(concat(stem, "_", c));
    return names;
}

std::vector<std::string> property_names(const Attribute& attribute)
{
    const std::size_t n = attribute.components;
    const bool vertex = attribute.domain != Domain::triangle;
    if (vertex && attribute.name == "normal" && n == 3) return {"nx", "ny", "nz"};
    if (vertex && attribute.name == "uv0" && n == 2) return {"s", "t"};
    const bool color = attribute.name == (vertex ? "color0" : "face_color");
    if (color && n == 3) return {"red", "green", "blue"};
    if (color && n == 4) return {"red", "green", "blue", "alpha"};
    return numbered(stem_of(attribute), n);
}

/// Two properties or attributes of one name would not be read back, nor would a_1 behind a_0 stay an attribute of its own.
void keep_apart(std::vector<PlyValues>& all, std::set<std::string> taken)
{
    std::set<std::string> further; // would be read as components of an attribute before
    for (PlyValues& columns : all) {
        std::vector<std::string>& names = columns.names;
        std::string stem = stem_of(*columns.attribute);
        const auto is_taken = [&](const std::string& name) { return taken.contains(name); };
        const auto clashes = [&] {
            return is_taken(stem) || further.contains(names.front()) || std::ranges::any_of(names, is_taken);
        };
        for (std::string next = stem; clashes(); next += '_') {
            stem = next;
            names = numbered(stem, names.size()); // all of them: the others would be attributes of their own
        }
        taken.insert(stem);
        taken.insert(names.begin(), names.end());
        const std::string& first = names.front();
        if (first.ends_with("_0")) further.insert(concat(first.substr(0, first.size() - 1), names.size()));
    }
}

std::string_view type_name(Scalar type)
{
    constexpr std::string_view names[] = {"float", "uchar", "ushort", "uint", "char", "short"};
    return names[static_cast<std::size_t>(type)];
}

/// Numbers of materials and groups say themselves that there is none.
bool has_none(const Attribute& attribute)
{
    return (attribute.name == "material" || attribute.name == "group") && attribute.type == Scalar::u32;
}

class PlyWriter {
public:
    PlyWriter(const Animation& animation, std::size_t frame, bool binary)
        : animation_(animation), frame_(frame), binary_(binary)
    {
        choose();
    }
    Bytes write();
    void tell_left_out(const SaveOptions& options) const;

private:
    void choose();
    void header();
    void rows();
    void float_number(float value);
    void count(std::uint8_t value);
    void index(std::uint32_t value);
    void values(const PlyValues& columns, std::size_t row);
    void end_row();
    void comments(std::string_view what, const std::vector<std::string>& names);

    const Animation& animation_;
    std::size_t frame_;
    bool binary_;
    std::vector<PlyValues> of_vertices_, of_faces_;
    const Attribute* corner_uvs_ = nullptr;
    std::vector<const Attribute*> seamed_, incomplete_;
    TextWriter text_;
    Bytes bytes_;
};

/// Sorts the attributes into columns of vertices and of faces, the texture coordinates of corners, and the rest.
void PlyWriter::choose()
{
    const std::string corner_uvs = corner_uv_name([&](const std::string& uv) { // as the reader has it
        const Attribute* found = animation_.appearance.find(uv);
        return found && (found->domain == Domain::triangle || vertex_values(*found, animation_));
    });
    for (const Attribute& attribute : animation_.appearance.attributes) {
        if (attribute.domain == Domain::triangle) {
            std::vector<std::uint32_t> value(animation_.triangles.size());
            for (std::size_t t = 0; t < value.size(); ++t)
                value[t] = attribute.indices.empty() ? static_cast<std::uint32_t>(t) : attribute.indices[t];
            of_faces_.push_back({&attribute, property_names(attribute), std::move(value)});
        } else if (auto value = vertex_values(attribute, animation_)) {
            of_vertices_.push_back({&attribute, property_names(attribute), std::move(*value)});
        } else if (attribute.name == corner_uvs && attribute.components == 2 && attribute.type == Scalar::f32) {
            corner_uvs_ = &attribute;
        } else {
            seamed_.push_back(&attribute);
        }
    }
    keep_apart(of_vertices_, {"x", "y", "z"});
    keep_apart(of_faces_, {"vertex_indices", "vertex_index", "texcoord"});
    for (const auto* table : {&of_vertices_, &of_faces_})
        for (const PlyValues& columns : *table)
            if (!has_none(*columns.attribute) && std::ranges::find(columns.value, no_value) != columns.value.end())
                incomplete_.push_back(columns.attribute);
}

void PlyWriter::tell_left_out(const SaveOptions& options) const
{
    for (const Attribute* attribute : seamed_)
        tell(options, concat("the attribute ", attribute->name,
                             " has several values at a vertex, which a PLY file cannot hold"));
    for (const Attribute* attribute : incomplete_)
        tell(options, concat("where the attribute ", attribute->name, " has no value, the PLY file says 0"));
}

void PlyWriter::comments(std::string_view what, const std::vector<std::string>& names)
{
    for (const std::string& name : names)
        text_.text("comment ").text(ply_comment_tag).text(" ").text(what).text(" ").name(name).text("\n");
}

void PlyWriter::header()
{
    text_.text("ply\nformat ").text(binary_ ? "binary_little_endian" : "ascii").text(" 1.0\n");
    comments("material", animation_.appearance.materials);
    comments("group", animation_.appearance.groups);
    const auto properties = [&](const std::vector<PlyValues>& all) {
        for (const PlyValues& columns : all)
            for (const std::string& name : columns.names)
                text_.text("property ").text(type_name(columns.attribute->type)).text(" ").text(name).text("\n");
    };
    text_.text("element vertex ")
        .number(animation_.vertex_count)
        .text("\nproperty float x\nproperty float y\nproperty float z\n");
    properties(of_vertices_);
    text_.text("element face ").number(animation_.triangles.size()).text("\nproperty list uchar uint vertex_indices\n");
    if (corner_uvs_) text_.text("property list uchar float texcoord\n");
    properties(of_faces_);
    text_.text("end_header\n");
}

void PlyWriter::float_number(float value)
{
    if (binary_)
        append_number(bytes_, value, ByteOrder::little);
    else
        text_.number(value).text(" ");
}

void PlyWriter::count(std::uint8_t value)
{
    if (binary_)
        bytes_.push_back(value);
    else
        text_.number(static_cast<unsigned>(value)).text(" ");
}

void PlyWriter::index(std::uint32_t value)
{
    if (binary_)
        append_number(bytes_, value, ByteOrder::little);
    else
        text_.number(value).text(" ");
}

/// The numbers of one row; zeros where it has none.
void PlyWriter::values(const PlyValues& columns, std::size_t row)
{
    const Attribute& attribute = *columns.attribute;
    const std::size_t size = scalar_size(attribute.type), value = columns.value[row];
    for (std::size_t c = 0; c < attribute.components; ++c) {
        const std::uint8_t* at = attribute.values.data() + (value * attribute.components + c) * size;
        if (binary_ && value != no_value)
            bytes_.insert(bytes_.end(), at, at + size);
        else if (binary_)
            bytes_.insert(bytes_.end(), size, has_none(attribute) ? 0xff : 0);
        else if (value == no_value)
            text_.text(has_none(attribute) ? "4294967295 " : "0 ");
        else if (attribute.type == Scalar::f32)
            float_number(attribute_float(attribute, value, c));
        else
            text_.number(attribute_integer(attribute, value, c)).text(" ");
    }
}

void PlyWriter::end_row()
{
    if (!binary_) text_.text("\n");
}

void PlyWriter::rows()
{
    const std::span<const float> positions = animation_.frame(frame_);
    for (std::size_t v = 0; v < animation_.vertex_count; ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) float_number(positions[v * 3 + axis]);
        for (const PlyValues& columns : of_vertices_) values(columns, v);
        end_row();
    }
    for (std::size_t t = 0; t < animation_.triangles.size(); ++t) {
        count(3);
        for (std::uint32_t v : animation_.triangles[t]) index(v);
        bool complete = corner_uvs_ != nullptr;
        for (std::size_t c = 0; c < 3 && complete; ++c)
            complete = corner_value(*corner_uvs_, animation_, t * 3 + c) != no_value;
        if (corner_uvs_) count(complete ? 6 : 0);
        for (std::size_t i = 0; i < 6 && complete; ++i)
            float_number(attribute_float(*corner_uvs_, corner_value(*corner_uvs_, animation_, t * 3 + i / 2), i % 2));
        for (const PlyValues& columns : of_faces_) values(columns, t);
        end_row();
    }
}

Bytes PlyWriter::write()
{
    header();
    if (binary_) bytes_ = text_.take();
    rows();
    return binary_ ? std::move(bytes_) : text_.take();
}

} // namespace

Result<Bytes> write_ply(const Animation& animation, std::size_t frame, const SaveOptions& options)
{
    PlyWriter writer(animation, frame, options.binary);
    if (frame == 0) writer.tell_left_out(options);
    return writer.write();
}

Status save_ply(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    return save_sequence(animation, path, options, write_ply);
}

} // namespace meshreel::io
