/// Reading MD3: a header, then surfaces with tables of their own.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/md3.h"

namespace meshreel::io {

namespace {

constexpr std::size_t name_size = 64, shader_size = 68, md3_triangle_size = 12, md3_st_size = 8, md3_vertex_size = 8;
constexpr std::size_t frame_size = 56, tag_size = 112;
constexpr float unit = 1.0f / 64.0f; ///< of a coordinate; exact in float32

/// One surface; its tables are views of the file.
struct Surface {
    std::string name, shader;
    std::uint64_t begin = 0; ///< byte of its header
    std::uint32_t vertices = 0;
    ByteView triangles, sts, positions;
    std::uint64_t triangles_at = 0;
};

class Md3Reader {
public:
    Md3Reader(ByteView bytes, const LoadOptions& options) : reader_(bytes, ByteOrder::little), options_(options) {}
    Result<Animation> read();

private:
    Result<std::uint64_t> count(std::string_view field);
    Status read_header();
    Status read_tags();
    Result<std::uint64_t> read_surface(std::uint64_t begin);
    Result<ByteView> table(std::uint64_t offset, std::uint64_t size, std::string_view field);
    Status signature(std::string_view what);
    Status add_triangles();
    void add_frames(const Selection& chosen);
    void carry();

    BinaryReader reader_;
    const LoadOptions& options_;
    std::uint64_t frames_ = 0, tags_ = 0, surface_count_ = 0, frames_at_ = 0, tags_at_ = 0, surfaces_at_ = 0;
    std::uint64_t vertices_ = 0, triangles_ = 0, more_shaders_ = 0;
    std::vector<Surface> surfaces_;
    Animation animation_;
};

/// A count or offset: a whole number that is not negative.
Result<std::uint64_t> Md3Reader::count(std::string_view field)
{
    const std::uint64_t at = reader_.offset();
    MESHREEL_TRY(const auto number, reader_.number<std::int32_t>(field));
    if (number < 0) return bad_input(concat(number, " is negative"), std::string(field), at_byte(at));
    return static_cast<std::uint64_t>(number);
}

Status Md3Reader::signature(std::string_view what)
{
    const std::uint64_t at = reader_.offset();
    MESHREEL_TRY(const ByteView found, reader_.bytes(4, "signature"));
    if (std::equal(found.begin(), found.end(), "IDP3")) return Ok{};
    return bad_input(concat("this is no ", what, ": it does not begin with IDP3"), "signature", at_byte(at));
}

Result<ByteView> Md3Reader::table(std::uint64_t offset, std::uint64_t size, std::string_view field)
{
    MESHREEL_CHECK(reader_.seek(offset, field));
    return reader_.bytes(size, field);
}

Status Md3Reader::read_header()
{
    MESHREEL_CHECK(signature("MD3 file"));
    MESHREEL_TRY(const auto version, reader_.number<std::int32_t>("version"));
    if (version != 15) return unsupported(concat("version ", version, " of MD3; version 15 is known"), "version");
    MESHREEL_TRY(animation_.meta.name, reader_.name(name_size, "name"));
    MESHREEL_CHECK(reader_.number<std::int32_t>("flags"));
    MESHREEL_TRY(frames_, count("frame_count"));
    MESHREEL_TRY(tags_, count("tag_count"));
    MESHREEL_TRY(surface_count_, count("surface_count"));
    MESHREEL_CHECK(count("skin_count"));
    MESHREEL_TRY(frames_at_, count("frame_offset"));
    MESHREEL_TRY(tags_at_, count("tag_offset"));
    MESHREEL_TRY(surfaces_at_, count("surface_offset"));
    MESHREEL_CHECK(table(frames_at_, frames_ * frame_size, "frames"));
    return Ok{};
}

Status Md3Reader::read_tags()
{
    if (tags_ == 0) return Ok{};
    MESHREEL_CHECK(table(tags_at_, tags_ * tag_size, "tags")); // so that the product below does not overflow
    MESHREEL_TRY(const ByteView rows, table(tags_at_, frames_ * tags_ * tag_size, "tags"));
    std::string names;
    for (std::uint64_t i = 0; i < tags_; ++i) {
        BinaryReader row(rows.subspan(i * tag_size), ByteOrder::little);
        MESHREEL_TRY(const std::string name, row.name(name_size, "tags"));
        names += (names.empty() ? "" : ", ") + name;
    }
    tell(options_, concat("the tags ", names, " are left out"));
    return Ok{};
}

/// Reads one surface's header and finds its tables. Returns where the next surface begins.
Result<std::uint64_t> Md3Reader::read_surface(std::uint64_t begin)
{
    MESHREEL_CHECK(reader_.seek(begin, "surface"));
    MESHREEL_CHECK(signature("surface"));
    Surface surface;
    surface.begin = begin;
    MESHREEL_TRY(surface.name, reader_.name(name_size, "surface name"));
    MESHREEL_CHECK(reader_.number<std::int32_t>("surface flags"));
    MESHREEL_TRY(const std::uint64_t frames, count("surface frame_count"));
    MESHREEL_TRY(const std::uint64_t shaders, count("shader_count"));
    MESHREEL_TRY(const std::uint64_t vertices, count("vertex_count"));
    MESHREEL_TRY(const std::uint64_t triangles, count("triangle_count"));
    std::uint64_t at[5] = {}; // triangles, shaders, texture coordinates, positions, end
    for (std::uint64_t& offset : at) {
        MESHREEL_TRY(offset, count("surface offset"));
        offset += begin;
    }
    if (frames != frames_)
        return bad_input(concat("the surface ", surface.name, " has ", frames, " frames, the file has ", frames_),
                         "frame_count", at_byte(begin + 72));
    if (at[4] <= begin) return bad_input("the surface ends where it begins", "surface offset", at_byte(begin + 104));
    surface.triangles_at = at[0];
    MESHREEL_TRY(surface.triangles, table(at[0], triangles * md3_triangle_size, "triangles"));
    MESHREEL_TRY(surface.sts, table(at[2], vertices * md3_st_size, "texture coordinates"));
    MESHREEL_TRY(surface.positions, table(at[3], frames * vertices * md3_vertex_size, "positions"));
    if (shaders > 0) {
        MESHREEL_TRY(const ByteView rows, table(at[1], shaders * shader_size, "shaders"));
        MESHREEL_TRY(surface.shader, BinaryReader(rows, ByteOrder::little).name(name_size, "shaders"));
    }
    more_shaders_ += shaders > 1 ? shaders - 1 : 0;
    surface.vertices = static_cast<std::uint32_t>(vertices);
    vertices_ += vertices;
    triangles_ += triangles;
    surfaces_.push_back(std::move(surface));
    return at[4];
}

Status Md3Reader::add_triangles()
{
    std::uint32_t base = 0;
    animation_.triangles.reserve(triangles_);
    for (const Surface& surface : surfaces_) {
        for (std::size_t at = 0; at < surface.triangles.size(); at += md3_triangle_size) {
            Triangle triangle{};
            for (std::size_t c = 0; c < 3; ++c) {
                const auto vertex = number_at<std::uint32_t>(surface.triangles.data() + at + 4 * c, ByteOrder::little);
                if (vertex >= surface.vertices)
                    return bad_input(concat("a triangle of the surface ", surface.name, " names vertex ", vertex,
                                            " of ", surface.vertices),
                                     "triangles", at_byte(surface.triangles_at + at + 4 * c));
                triangle[c] = base + vertex;
            }
            animation_.triangles.push_back(triangle);
        }
        base += surface.vertices;
    }
    return Ok{};
}

void Md3Reader::add_frames(const Selection& chosen)
{
    animation_.positions.reserve(chosen.count * vertices_ * 3);
    for (std::uint64_t i = 0; i < chosen.count; ++i)
        for (const Surface& surface : surfaces_) {
            const std::uint8_t* vertex = surface.positions.data() + chosen[i] * surface.vertices * md3_vertex_size;
            for (std::uint32_t v = 0; v < surface.vertices; ++v, vertex += md3_vertex_size)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    animation_.positions.push_back(
                        static_cast<float>(number_at<std::int16_t>(vertex + 2 * axis, ByteOrder::little)) * unit);
        }
}

void Md3Reader::carry()
{
    Appearance& appearance = animation_.appearance;
    Attribute uvs{"uv0", Domain::vertex, Scalar::f32, 2, false, {}, {}};
    std::vector<std::uint32_t> materials, groups;
    for (std::uint32_t s = 0; s < surfaces_.size(); ++s) {
        const Surface& surface = surfaces_[s];
        uvs.values.insert(uvs.values.end(), surface.sts.begin(), surface.sts.end()); // little-endian already
        auto known = std::ranges::find(appearance.materials, surface.shader);
        if (known == appearance.materials.end() && !surface.shader.empty()) {
            appearance.materials.push_back(surface.shader);
            known = appearance.materials.end() - 1;
        }
        const std::size_t count = surface.triangles.size() / md3_triangle_size;
        const bool has_shader = !surface.shader.empty();
        materials.insert(materials.end(), count,
                         has_shader ? static_cast<std::uint32_t>(known - appearance.materials.begin()) : no_value);
        groups.insert(groups.end(), count, s);
        appearance.groups.push_back(surface.name);
    }
    appearance.attributes.push_back(std::move(uvs));
    if (!animation_.triangles.empty() && !appearance.materials.empty())
        appearance.attributes.push_back(triangle_numbers("material", materials));
    if (!animation_.triangles.empty()) appearance.attributes.push_back(triangle_numbers("group", groups));
    if (more_shaders_ > 0)
        tell(options_, concat(more_shaders_, " shaders beside the first of their surface are left out"));
    tell(options_, "the normals of the frames are left out");
}

Result<Animation> Md3Reader::read()
{
    MESHREEL_CHECK(read_header());
    if (!options_.clip.empty())
        return Error{ErrorCode::usage, "an MD3 file does not name its clips; choose a range of frames", "clip", {}, {}};
    MESHREEL_TRY(const Selection chosen, select_frames(options_.frames, frames_));
    MESHREEL_CHECK(read_tags());
    std::uint64_t begin = surfaces_at_;
    for (std::uint64_t s = 0; s < surface_count_; ++s) {
        MESHREEL_TRY(begin, read_surface(begin));
        MESHREEL_CHECK(within(options_.limits, vertices_, triangles_, chosen.count));
    }
    if (vertices_ == 0 || vertices_ >= no_value)
        return bad_input(concat(vertices_, " vertices"), "vertex_count", at_byte(surfaces_at_));
    animation_.vertex_count = static_cast<std::uint32_t>(vertices_);
    MESHREEL_CHECK(add_triangles());
    add_frames(chosen);
    carry();
    give_times(animation_, chosen, options_);
    return std::move(animation_);
}

} // namespace

Result<Animation> parse_md3(ByteView bytes, const LoadOptions& options)
{
    return Md3Reader(bytes, options).read();
}

Result<Animation> load_md3(const std::string& path, const LoadOptions& options)
{
    MESHREEL_CHECK(check_fps(options));
    MESHREEL_TRY(const Bytes bytes, read_file(path, options.limits));
    return in_file(parse_md3(bytes, named_warnings(options, path)), path);
}

} // namespace meshreel::io
