/// Reading MD2: a header of counts and offsets, tables behind it.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "meshreel/base/file.h"
#include "meshreel/base/text.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/frames.h"
#include "meshreel/io/md2.h"

namespace meshreel::io {

namespace {

constexpr std::size_t skin_size = 64, md2_st_size = 4, md2_triangle_size = 12, md2_vertex_size = 4;
constexpr std::size_t frame_header_size = 40; ///< scale[3], translate[3] as float32, name[16]

/// The header's numbers in the order of the file.
struct Header {
    std::int32_t signature, version, skin_width, skin_height, frame_size;
    std::int32_t skins, vertices, sts, triangles, commands, frames;
    std::int32_t skins_at, sts_at, triangles_at, frames_at, commands_at, end_at;
};

constexpr std::array header_fields{"signature",      "version",      "skin_width", "skin_height",     "frame_size",
                                   "skin_count",     "vertex_count", "st_count",   "triangle_count",  "command_count",
                                   "frame_count",    "skin_offset",  "st_offset",  "triangle_offset", "frame_offset",
                                   "command_offset", "end_offset"};
constexpr std::array header_members{
    &Header::signature,   &Header::version,  &Header::skin_width, &Header::skin_height,  &Header::frame_size,
    &Header::skins,       &Header::vertices, &Header::sts,        &Header::triangles,    &Header::commands,
    &Header::frames,      &Header::skins_at, &Header::sts_at,     &Header::triangles_at, &Header::frames_at,
    &Header::commands_at, &Header::end_at};

class Md2Reader {
public:
    Md2Reader(ByteView bytes, const LoadOptions& options) : bytes_(bytes), options_(options) {}
    Result<Animation> read();

private:
    Status read_header();
    Result<ByteView> table(std::int32_t offset, std::int32_t count, std::size_t row, std::string_view field) const;
    std::vector<std::string> frame_names(ByteView frames) const;
    Result<Md2Clip> choose_clip(ByteView frames) const;
    Status read_triangles();
    Status read_frames(ByteView frames, const Md2Clip& clip, const Selection& chosen);
    Status carry();

    ByteView bytes_;
    const LoadOptions& options_;
    Header header_{};
    std::vector<std::uint32_t> st_of_;
    Animation animation_;
};

Status Md2Reader::read_header()
{
    BinaryReader reader(bytes_, ByteOrder::little);
    for (std::size_t i = 0; i < header_members.size(); ++i) {
        MESHREEL_TRY(header_.*header_members[i], reader.number<std::int32_t>(header_fields[i]));
        if (i == 0 && !std::equal(bytes_.begin(), bytes_.begin() + 4, "IDP2"))
            return bad_input("this is no MD2 file: it does not begin with IDP2", "signature", at_byte(0));
        if (i == 1 && header_.version != 8)
            return unsupported(concat("version ", header_.version, " of MD2; version 8 is known"), "version");
        if (header_.*header_members[i] < 0)
            return bad_input(concat(header_.*header_members[i], " is negative"), header_fields[i], at_byte(4 * i));
    }
    if (header_.vertices == 0 || header_.frames == 0)
        return bad_input("there is no vertex or no frame", "vertex_count", at_byte(24));
    const std::uint64_t smallest = frame_header_size + md2_vertex_size * static_cast<std::uint64_t>(header_.vertices);
    if (static_cast<std::uint64_t>(header_.frame_size) < smallest)
        return bad_input(
            concat("a frame of ", header_.frame_size, " bytes, but ", header_.vertices, " vertices need ", smallest),
            "frame_size", at_byte(16));
    return Ok{};
}

Result<ByteView> Md2Reader::table(std::int32_t offset, std::int32_t count, std::size_t row,
                                  std::string_view field) const
{
    BinaryReader reader(bytes_, ByteOrder::little);
    MESHREEL_CHECK(reader.seek(static_cast<std::uint64_t>(offset), field));
    return reader.bytes(static_cast<std::uint64_t>(count) * row, field);
}

std::vector<std::string> Md2Reader::frame_names(ByteView frames) const
{
    std::vector<std::string> names;
    for (std::int32_t f = 0; f < header_.frames; ++f) {
        const ByteView field =
            frames.subspan(static_cast<std::size_t>(f) * static_cast<std::size_t>(header_.frame_size) + 24, 16);
        const std::string name(field.begin(), field.end());
        names.push_back(name.substr(0, name.find('\0')));
    }
    return names;
}

Result<Md2Clip> Md2Reader::choose_clip(ByteView frames) const
{
    const std::vector<Md2Clip> clips = md2_clips(frame_names(frames));
    std::string list;
    for (const Md2Clip& clip : clips) {
        if (!options_.clip.empty() && clip.name == options_.clip) return clip;
        list += concat(list.empty() ? "" : ", ", clip.name, " (", clip.count, ")");
    }
    if (!options_.clip.empty())
        return Error{
            ErrorCode::usage, concat("there is no clip ", options_.clip, "; there are: ", list), "clip", {}, {}};
    if (clips.size() > 1) tell(options_, "all frames are read; the clips are: " + list);
    return Md2Clip{"", 0, static_cast<std::uint64_t>(header_.frames)};
}

Status Md2Reader::read_triangles()
{
    MESHREEL_TRY(const ByteView rows, table(header_.triangles_at, header_.triangles, md2_triangle_size, "triangles"));
    const auto at = static_cast<std::size_t>(header_.triangles_at);
    animation_.triangles.resize(static_cast<std::size_t>(header_.triangles));
    st_of_.resize(animation_.triangles.size() * 3);
    for (std::size_t corner = 0; corner < st_of_.size(); ++corner) {
        const std::size_t vertex_at = corner / 3 * md2_triangle_size + corner % 3 * 2, st_at = vertex_at + 6;
        const auto vertex = number_at<std::uint16_t>(rows.data() + vertex_at, ByteOrder::little);
        const auto st = number_at<std::uint16_t>(rows.data() + st_at, ByteOrder::little);
        if (vertex >= header_.vertices)
            return bad_input(concat("triangle ", corner / 3, " names vertex ", vertex, " of ", header_.vertices),
                             "triangles", at_byte(at + vertex_at));
        if (header_.sts > 0 && st >= header_.sts)
            return bad_input(concat("triangle ", corner / 3, " names texture coordinate ", st, " of ", header_.sts),
                             "triangles", at_byte(at + st_at));
        animation_.triangles[corner / 3][corner % 3] = vertex;
        st_of_[corner] = st;
    }
    return Ok{};
}

Status Md2Reader::read_frames(ByteView frames, const Md2Clip& clip, const Selection& chosen)
{
    animation_.positions.resize(chosen.count * animation_.vertex_count * 3);
    for (std::uint64_t i = 0; i < chosen.count; ++i) {
        const std::uint8_t* frame =
            frames.data() + (clip.first + chosen[i]) * static_cast<std::uint64_t>(header_.frame_size);
        float place[6]; // scale, translate
        copy_floats({frame, 24}, ByteOrder::little, place);
        float* positions = animation_.positions.data() + i * animation_.vertex_count * 3;
        const std::uint8_t* vertex = frame + frame_header_size;
        for (std::size_t v = 0; v < animation_.vertex_count; ++v, vertex += md2_vertex_size)
            for (std::size_t axis = 0; axis < 3; ++axis)
                positions[v * 3 + axis] = static_cast<float>(vertex[axis]) * place[axis] + place[3 + axis];
        MESHREEL_CHECK(check_finite({positions, animation_.vertex_count * 3ul}, clip.first + chosen[i]));
    }
    return Ok{};
}

Status Md2Reader::carry()
{
    MESHREEL_TRY(const ByteView sts, table(header_.sts_at, header_.sts, md2_st_size, "texture coordinates"));
    MESHREEL_TRY(const ByteView skins, table(header_.skins_at, header_.skins, skin_size, "skins"));
    Appearance& appearance = animation_.appearance;
    const float size[2] = {static_cast<float>(std::max(header_.skin_width, 1)),
                           static_cast<float>(std::max(header_.skin_height, 1))};
    std::vector<float> uvs(static_cast<std::size_t>(header_.sts) * 2);
    for (std::size_t i = 0; i < uvs.size(); ++i)
        uvs[i] = static_cast<float>(number_at<std::int16_t>(sts.data() + 2 * i, ByteOrder::little)) / size[i % 2];
    if (!uvs.empty() && !animation_.triangles.empty())
        appearance.attributes.push_back(indexed(float_attribute("uv0", Domain::corner, 2, uvs), std::move(st_of_)));
    BinaryReader names(skins, ByteOrder::little);
    for (std::int32_t i = 0; i < header_.skins; ++i) {
        MESHREEL_TRY(std::string name, names.name(skin_size, "skins"));
        appearance.materials.push_back(std::move(name));
    }
    if (header_.skins > 0 && !animation_.triangles.empty())
        appearance.attributes.push_back(
            triangle_numbers("material", std::vector<std::uint32_t>(animation_.triangles.size(), 0)));
    if (header_.skins > 1)
        tell(options_, concat(header_.skins, " skins are carried by name; the triangles have the first"));
    tell(options_, "the normals of the frames are left out");
    return Ok{};
}

Result<Animation> Md2Reader::read()
{
    MESHREEL_CHECK(read_header());
    MESHREEL_TRY(const ByteView frames,
                 table(header_.frames_at, header_.frames, static_cast<std::size_t>(header_.frame_size), "frames"));
    MESHREEL_TRY(const Md2Clip clip, choose_clip(frames));
    MESHREEL_TRY(const Selection chosen, select_frames(options_.frames, clip.count));
    animation_.vertex_count = static_cast<std::uint32_t>(header_.vertices);
    MESHREEL_CHECK(
        within(options_.limits, animation_.vertex_count, static_cast<std::uint64_t>(header_.triangles), chosen.count));
    MESHREEL_CHECK(read_triangles());
    MESHREEL_CHECK(read_frames(frames, clip, chosen));
    MESHREEL_CHECK(carry());
    give_times(animation_, chosen, options_, md2_fps);
    animation_.meta.name = clip.name;
    return std::move(animation_);
}

/// A frame's name cut into its clip and its number.
struct FrameName {
    std::string stem, digits;
    std::uint64_t number = 0;
};

FrameName cut(const std::string& name)
{
    constexpr std::size_t most_digits = 9;
    std::size_t begin = name.size();
    while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9' && name.size() - begin < most_digits) --begin;
    FrameName parts{name.substr(0, begin), name.substr(begin), 0};
    for (char c : parts.digits) parts.number = parts.number * 10 + static_cast<std::uint64_t>(c - '0');
    return parts;
}

/// "pain101" begins the clip "pain1", "run001" the clip "run".
std::string clip_name(const FrameName& first)
{
    if (first.digits.size() < 3) return first.stem;
    const std::string series = first.digits.substr(0, first.digits.size() - 2);
    const std::size_t nonzero = series.find_first_not_of('0');
    return nonzero == std::string::npos ? first.stem : first.stem + series.substr(nonzero);
}

} // namespace

std::vector<Md2Clip> md2_clips(std::span<const std::string> frame_names)
{
    std::vector<Md2Clip> clips;
    FrameName before;
    for (std::size_t f = 0; f < frame_names.size(); ++f) {
        FrameName name = cut(frame_names[f]);
        const bool goes_on = f > 0 && name.stem == before.stem && name.number == before.number + 1;
        std::string clip = goes_on ? clips.back().name : clip_name(name);
        if (clips.empty() || clip != clips.back().name) clips.push_back({std::move(clip), f, 0});
        ++clips.back().count;
        before = std::move(name);
    }
    return clips;
}

Result<Animation> parse_md2(ByteView bytes, const LoadOptions& options)
{
    return Md2Reader(bytes, options).read();
}

Result<Animation> load_md2(const std::string& path, const LoadOptions& options)
{
    MESHREEL_CHECK(check_fps(options));
    MESHREEL_TRY(const Bytes bytes, read_file(path, options.limits));
    return in_file(parse_md2(bytes, named_warnings(options, path)), path);
}

} // namespace meshreel::io
