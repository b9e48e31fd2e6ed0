/// Writing OBJ: tables first, then the faces in their order.
// SPDX-License-Identifier: MIT
#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/obj.h"
#include "meshreel/io/sequence.h"
#include "meshreel/io/text_write.h"

namespace meshreel::io {

namespace {

constexpr std::string_view library_type = "model/mtl";

std::string file_name(const std::string& path)
{
    return path.substr(path.rfind('/') + 1);
}

/// A name that ends with a backslash would swallow the next line.
std::string one_line(std::string name)
{
    while (name.ends_with('\\')) name.back() = '_';
    return name;
}

/// The attributes that an OBJ file holds; null where there is none.
struct ObjAttributes {
    const Attribute *uv, *normal, *color, *material, *group, *smoothing;
};

const Attribute* find(const Animation& animation, const char* name, bool on_triangles, std::size_t fewest)
{
    const Attribute* found = animation.appearance.find(name);
    if (!found || (found->domain == Domain::triangle) != on_triangles || found->components < fewest) return nullptr;
    if (on_triangles && (found->components != 1 || found->type == Scalar::f32)) return nullptr;
    return found;
}

ObjAttributes attributes_of(const Animation& animation)
{
    ObjAttributes all{find(animation, "uv0", false, 2),    find(animation, "normal", false, 3),
                      find(animation, "color0", false, 3), find(animation, "material", true, 1),
                      find(animation, "group", true, 1),   find(animation, "smoothing", true, 1)};
    if (all.color && all.color->domain != Domain::vertex) all.color = nullptr;
    return all;
}

void tell_obj_left_out(const Animation& animation, const ObjAttributes& all, const SaveOptions& options)
{
    std::vector<std::string_view> held;
    for (const Attribute* attribute : {all.uv, all.normal, all.color, all.material, all.group, all.smoothing})
        if (attribute) held.push_back(attribute->name);
    tell_left_out(animation, held, options);
}

class ObjWriter {
public:
    ObjWriter(const Animation& animation, std::size_t frame)
        : animation_(animation), frame_(frame), all_(attributes_of(animation))
    {
    }
    Bytes write();

private:
    void vertices();
    void table(std::string_view keyword, const Attribute* attribute, std::size_t most);
    void state(std::size_t triangle);
    void named(std::string_view keyword, std::uint32_t number, const std::vector<std::string>& names);
    void corner(std::size_t corner);

    const Animation& animation_;
    std::size_t frame_;
    ObjAttributes all_;
    TextWriter out_;
    std::uint32_t material_ = no_value, group_ = no_value, smoothing_ = 0;
};

void ObjWriter::vertices()
{
    const std::span<const float> positions = animation_.frame(frame_);
    for (std::size_t v = 0; v < animation_.vertex_count; ++v) {
        out_.text("v");
        for (std::size_t axis = 0; axis < 3; ++axis) out_.text(" ").number(positions[v * 3 + axis]);
        const Attribute* color = all_.color;
        const std::size_t value = !color ? no_value : color->indices.empty() ? v : color->indices[v];
        for (std::size_t i = 0; value != no_value && i < std::min<std::size_t>(color->components, 4); ++i)
            out_.text(" ").number(attribute_float(*color, value, i));
        out_.text("\n");
    }
}

void ObjWriter::table(std::string_view keyword, const Attribute* attribute, std::size_t most)
{
    for (std::size_t i = 0; attribute && i < attribute->value_count(); ++i) {
        out_.text(keyword);
        for (std::size_t c = 0; c < std::min<std::size_t>(attribute->components, most); ++c)
            out_.text(" ").number(attribute_float(*attribute, i, c));
        out_.text("\n");
    }
}

void ObjWriter::named(std::string_view keyword, std::uint32_t number, const std::vector<std::string>& names)
{
    out_.text(keyword);
    if (number < names.size() && !names[number].empty())
        out_.text(" ").name(one_line(names[number]));
    else if (number != no_value)
        out_.text(" ").number(number);
    out_.text("\n");
}

/// The lines that change what the triangles from here on belong to.
void ObjWriter::state(std::size_t triangle)
{
    const std::uint32_t group = all_.group ? triangle_number(*all_.group, triangle) : no_value;
    const std::uint32_t material = all_.material ? triangle_number(*all_.material, triangle) : no_value;
    const std::uint32_t smoothing = all_.smoothing ? triangle_number(*all_.smoothing, triangle) : 0;
    if (group != group_) named("g", group_ = group, animation_.appearance.groups);
    if (material != material_) named("usemtl", material_ = material, animation_.appearance.materials);
    if (smoothing != smoothing_ && smoothing != no_value) out_.text("s ").number(smoothing_ = smoothing).text("\n");
}

void ObjWriter::corner(std::size_t corner)
{
    const std::uint32_t uv = all_.uv ? corner_value(*all_.uv, animation_, corner) : no_value;
    const std::uint32_t normal = all_.normal ? corner_value(*all_.normal, animation_, corner) : no_value;
    out_.text(" ").number(animation_.triangles[corner / 3][corner % 3] + 1ull);
    if (uv != no_value || normal != no_value) out_.text("/");
    if (uv != no_value) out_.number(uv + 1ull);
    if (normal != no_value) out_.text("/").number(normal + 1ull);
}

Bytes ObjWriter::write()
{
    for (const Asset& asset : animation_.appearance.assets)
        if (asset.mime_type == library_type) out_.text("mtllib ").name(one_line(file_name(asset.name))).text("\n");
    vertices();
    table("vt", all_.uv, 3);
    table("vn", all_.normal, 3);
    for (std::size_t t = 0; t < animation_.triangles.size(); ++t) {
        state(t);
        out_.text("f");
        for (std::size_t c = 0; c < 3; ++c) corner(t * 3 + c);
        out_.text("\n");
    }
    return out_.take();
}

} // namespace

Result<Bytes> write_obj(const Animation& animation, std::size_t frame, const SaveOptions& options)
{
    if (frame == 0) tell_obj_left_out(animation, attributes_of(animation), options);
    return ObjWriter(animation, frame).write();
}

Status save_obj(const Animation& animation, const std::string& path, const SaveOptions& options)
{
    FileSet files(options.overwrite);
    MESHREEL_CHECK(add_sequence(files, animation, {path, write_obj}, options));
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    for (const Asset& asset : animation.appearance.assets) {
        if (asset.mime_type != library_type || asset.bytes.empty()) continue;
        if (!asset.name.ends_with(".mtl")) { // a name from outside must not replace any other kind of file
            tell(options, "a material library is not written, because its name does not end in .mtl: " + asset.name);
            continue;
        }
        const std::string beside = folder + file_name(asset.name);
        const auto there = read_file(beside);
        if (there.ok() && *there == asset.bytes) continue;
        MESHREEL_CHECK(files.add(beside, asset.bytes));
    }
    return files.commit();
}

} // namespace meshreel::io
