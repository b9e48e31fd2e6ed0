/// Writing OFF with whatever of normals, colours and texture coordinates each vertex has.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/off.h"
#include "meshreel/io/sequence.h"
#include "meshreel/io/text_write.h"

namespace meshreel::io {

namespace {

/// An attribute that each vertex has exactly one value of.
struct VertexTable {
    const Attribute* attribute = nullptr;
    std::vector<std::uint32_t> value;

    explicit operator bool() const { return attribute != nullptr; }
};

VertexTable table_of(const Animation& animation, const char* name, std::size_t fewest, std::size_t most)
{
    const Attribute* found = animation.appearance.find(name);
    if (!found || found->components < fewest || found->components > most) return {};
    auto values = vertex_values(*found, animation);
    if (!values || std::ranges::find(*values, no_value) != values->end()) return {};
    return {found, std::move(*values)};
}

/// Readers take whole numbers for bytes where some is above 1.
bool as_bytes(const Attribute& attribute)
{
    return attribute.type == Scalar::u8 &&
           std::ranges::any_of(attribute.values, [](std::uint8_t value) { return value > 1; });
}

/// A colour: bytes as whole numbers, anything else as fractions, which are told apart by their points.
void color(TextWriter& out, const Attribute& attribute, bool bytes, std::size_t value)
{
    for (std::size_t c = 0; c < attribute.components; ++c) {
        out.text(" ");
        if (bytes) {
            out.number(attribute_integer(attribute, value, c));
            continue;
        }
        TextWriter digits;
        digits.number(attribute_float(attribute, value, c));
        const Bytes text = digits.take();
        const std::string_view view(reinterpret_cast<const char*>(text.data()), text.size());
        out.text(view).text(view.find_first_of(".einf") == std::string_view::npos ? ".0" : "");
    }
}

class OffWriter {
public:
    explicit OffWriter(const Animation& animation)
        : animation_(animation), normals_(table_of(animation, "normal", 3, 3)),
          colors_(table_of(animation, "color0", 3, 4)), uvs_(table_of(animation, "uv0", 2, 2)),
          face_colors_(animation.appearance.find("face_color"))
    {
        const bool fits = face_colors_ && face_colors_->domain == Domain::triangle && face_colors_->components >= 3 &&
                          face_colors_->components <= 4;
        if (!fits) face_colors_ = nullptr;
    }
    Bytes write(std::size_t frame) const;
    void tell_left_out(const SaveOptions& options) const;

private:
    void floats(TextWriter& out, const VertexTable& table, std::size_t vertex) const;

    const Animation& animation_;
    VertexTable normals_, colors_, uvs_;
    const Attribute* face_colors_;
};

void OffWriter::tell_left_out(const SaveOptions& options) const
{
    std::vector<std::string_view> held;
    for (const Attribute* attribute : {normals_.attribute, colors_.attribute, uvs_.attribute, face_colors_})
        if (attribute) held.push_back(attribute->name);
    io::tell_left_out(animation_, held, options);
}

void OffWriter::floats(TextWriter& out, const VertexTable& table, std::size_t vertex) const
{
    for (std::size_t c = 0; table && c < table.attribute->components; ++c)
        out.text(" ").number(attribute_float(*table.attribute, table.value[vertex], c));
}

Bytes OffWriter::write(std::size_t frame) const
{
    TextWriter out;
    out.text(uvs_ ? "ST" : "").text(colors_ ? "C" : "").text(normals_ ? "N" : "").text("OFF\n");
    out.number(animation_.vertex_count).text(" ").number(animation_.triangles.size()).text(" 0\n");
    const std::span<const float> positions = animation_.frame(frame);
    const bool vertex_bytes = colors_ && as_bytes(*colors_.attribute),
               face_bytes = face_colors_ && as_bytes(*face_colors_);
    for (std::size_t v = 0; v < animation_.vertex_count; ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) out.text(axis == 0 ? "" : " ").number(positions[v * 3 + axis]);
        floats(out, normals_, v);
        if (colors_) color(out, *colors_.attribute, vertex_bytes, colors_.value[v]);
        floats(out, uvs_, v);
        out.text("\n");
    }
    for (std::size_t t = 0; t < animation_.triangles.size(); ++t) {
        out.text("3");
        for (std::uint32_t v : animation_.triangles[t]) out.text(" ").number(v);
        const bool indexed = face_colors_ && !face_colors_->indices.empty();
        const std::size_t value = !face_colors_ ? no_value : indexed ? face_colors_->indices[t] : t;
        if (value != no_value) color(out, *face_colors_, face_bytes, value);
        out.text("\n");
    }
    return out.take();
}

} // namespace

Result<Bytes> write_off(const Animation& animation, std::size_t frame, const SaveOptions& options)
{
    const OffWriter writer(animation);
    if (frame == 0) writer.tell_left_out(options);
    return writer.write(frame);
}

Status save_off(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    return save_sequence(animation, path, options, write_off);
}

} // namespace meshreel::io
