/// MD2 and MD3: frames, clips, surfaces, and broken files.
// SPDX-License-Identifier: MIT
#include "meshreel/io/attributes.h"
#include "meshreel/io/binary_read.h"
#include "meshreel/io/md2.h"
#include "meshreel/io/md3.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

void put(Bytes& bytes, std::initializer_list<std::int32_t> numbers)
{
    for (std::int32_t number : numbers) append_number(bytes, number, ByteOrder::little);
}
void put(Bytes& bytes, std::initializer_list<float> numbers)
{
    for (float number : numbers) append_number(bytes, number, ByteOrder::little);
}
void put16(Bytes& bytes, std::initializer_list<int> numbers)
{
    for (int number : numbers) append_number(bytes, static_cast<std::int16_t>(number), ByteOrder::little);
}
void put_name(Bytes& bytes, std::string name, std::size_t size)
{
    name.resize(size);
    bytes.insert(bytes.end(), name.begin(), name.end());
}

/// Three vertices, one triangle, four texture coordinates, a skin, a frame a name.
Bytes made_md2(const std::vector<std::string>& names)
{
    const auto frames = static_cast<std::int32_t>(names.size());
    const std::int32_t skins = 68, sts = skins + 64, triangles = sts + 16, first = triangles + 12;
    Bytes bytes = bytes_of("IDP2");
    put(bytes,
        {8, 64, 32, 52, 1, 3, 4, 1, 0, frames, skins, sts, triangles, first, first + 52 * frames, first + 52 * frames});
    put_name(bytes, "models/skin.pcx", 64);
    put16(bytes, {0, 0, 32, 0, 0, 16, -64, 8});
    put16(bytes, {0, 2, 1, 0, 1, 3});
    for (std::int32_t f = 0; f < frames; ++f) {
        put(bytes, {0.5f, 1.0f, 2.0f, static_cast<float>(f), 0.0f, -1.0f});
        put_name(bytes, names[static_cast<std::size_t>(f)], 16);
        for (const int v : {0, 0, 0, 9, 2, 4, 6, 9, 255, 1, 0, 9}) bytes.push_back(static_cast<std::uint8_t>(v));
    }
    return bytes;
}

void put_surface(Bytes& bytes, const std::string& name, const std::string& shader, int frames)
{
    const std::int32_t shaders = 108, triangles = shaders + 68, sts = triangles + 12, positions = sts + 24;
    put_name(bytes, "IDP3" + name, 68);
    put(bytes, {0, frames, 1, 3, 1, triangles, shaders, sts, positions, positions + 24 * frames});
    put_name(bytes, shader, 68);
    put(bytes, {0, 2, 1});
    put(bytes, {0.0f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f});
    for (int f = 0; f < frames; ++f) put16(bytes, {f, 0, -64, 0, 64, 1, 0, 0, 32767, -32768, 5, 0});
}

Bytes made_md3(int frames, int tags = 1)
{
    const std::int32_t frames_at = 108, tags_at = frames_at + 56 * frames, surfaces = tags_at + 112 * frames * tags;
    Bytes bytes = bytes_of("IDP3");
    put(bytes, {15});
    put_name(bytes, "soldier", 64);
    put(bytes, {0, frames, tags, 2, 0, frames_at, tags_at, surfaces, 0});
    bytes.resize(static_cast<std::size_t>(surfaces));
    std::copy_n("tag_head", 8, bytes.begin() + tags_at);
    put_surface(bytes, "body", "paint", frames);
    put_surface(bytes, "head", "skin", frames);
    return bytes;
}

std::vector<std::string> clip_list(std::vector<std::string> names)
{
    std::vector<std::string> list;
    for (const Md2Clip& clip : md2_clips(names))
        list.push_back(clip.name + " " + std::to_string(clip.first) + "+" + std::to_string(clip.count));
    return list;
}

template <class Parse>
void expect_sound(const Bytes& good, Parse parse)
{
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(parse(ByteView(good).first(size), {}).ok()) << size;
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        Bytes bad = good;
        bad[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        const auto read = parse(bad, {});
        EXPECT_TRUE(!read.ok() || validate(*read).ok()) << bit << ' ' << why(validate(*read));
    }
}

} // namespace

TEST(Md2, PositionsTextureCoordinatesAndSkinsAreRead)
{
    const auto read = parse_md2(made_md2({"a1", "a2"}), {});
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->positions,
              (std::vector<float>{0, 0, -1, 1, 4, 11, 127.5, 1, -1, 1, 0, -1, 2, 4, 11, 128.5, 1, -1}));
    EXPECT_EQ(read->triangles, (std::vector<Triangle>{{0, 2, 1}}));
    const Attribute* uvs = read->appearance.find("uv0");
    EXPECT_EQ(uvs->indices, (std::vector<std::uint32_t>{0, 1, 3}));
    EXPECT_EQ(attribute_float(*uvs, 3, 0), -1.0f);
    EXPECT_EQ(attribute_float(*uvs, 3, 1), 0.25f);
    EXPECT_EQ(read->appearance.materials, (std::vector<std::string>{"models/skin.pcx"}));
    EXPECT_EQ(read->times_s, (std::vector<double>{0, 0.1}));
}

TEST(Md2, ClipsAreTheNamesOfFramesWithoutTheirNumbers)
{
    using List = std::vector<std::string>;
    EXPECT_EQ(clip_list({"stand01", "stand02", "run1", "run2", "run3"}), (List{"stand 0+2", "run 2+3"}));
    EXPECT_EQ(clip_list({"pain101", "pain102", "pain201", "pain202"}), (List{"pain1 0+2", "pain2 2+2"}));
    EXPECT_EQ(clip_list({"run099", "run100", "run101"}), (List{"run 0+3"}));
    EXPECT_EQ(clip_list({"a1", "a3", "b"}), (List{"a 0+2", "b 2+1"}));
    EXPECT_EQ(clip_list({}), List{});
}

TEST(Md2, AClipIsChosenByName)
{
    Listener listener;
    listener.options.clip = "run";
    listener.options.fps = 5;
    const Bytes bytes = made_md2({"stand1", "stand2", "run1", "run2"});
    const auto read = parse_md2(bytes, listener.options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->frame_count(), 2u);
    EXPECT_EQ(read->frame(0)[0], 2.0f);
    EXPECT_EQ(read->times_s, (std::vector<double>{0, 0.2}));
    listener.options.clip = "fly";
    EXPECT_EQ(why(parse_md2(bytes, listener.options)), "clip: there is no clip fly; there are: stand (2), run (2)");
}

TEST(Md3, SurfacesBecomeGroupsOfOneMesh)
{
    Listener listener;
    const auto read = parse_md3(made_md3(3), listener.options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->vertex_count, 6u);
    EXPECT_EQ(read->frame_count(), 3u);
    EXPECT_EQ(read->triangles, (std::vector<Triangle>{{0, 2, 1}, {3, 5, 4}}));
    EXPECT_EQ(read->frame(2)[9], 2 / 64.0f);
    EXPECT_EQ(read->frame(2)[8], 5 / 64.0f);
    EXPECT_EQ(read->appearance.groups, (std::vector<std::string>{"body", "head"}));
    EXPECT_EQ(read->appearance.materials, (std::vector<std::string>{"paint", "skin"}));
    EXPECT_EQ(triangle_number(*read->appearance.find("material"), 1), 1u);
    EXPECT_EQ(attribute_float(*read->appearance.find("uv0"), 5, 1), 0.5f);
    EXPECT_EQ(read->meta.name, "soldier");
    EXPECT_TRUE(listener.has("the tags tag_head are left out"));
}

TEST(Md2, EveryTruncationAndFlippedBitGivesAnErrorOrAValidAnimation)
{
    expect_sound(made_md2({"a1", "a2"}), parse_md2);
}

TEST(Md3, EveryTruncationAndFlippedBitGivesAnErrorOrAValidAnimation)
{
    expect_sound(made_md3(2), parse_md3);
}

TEST(Md2, ErrorsNameByteAndField)
{
    EXPECT_EQ(why(parse_md2(bytes_of("IDP3    "), {})),
              "byte 0: signature: this is no MD2 file: it does not begin with IDP2");
    Bytes bytes = made_md2({"a"});
    bytes[43] = 0x70; // 1.9 thousand million frames
    EXPECT_NE(why(parse_md2(bytes, {})).find("frames: needs "), std::string::npos);
    bytes = made_md2({"a"});
    bytes[148] = 3;
    EXPECT_EQ(why(parse_md2(bytes, {})), "byte 148: triangles: triangle 0 names vertex 3 of 3");
    bytes = made_md2({"a"});
    bytes[16] = 51;
    EXPECT_EQ(why(parse_md2(bytes, {})), "byte 16: frame_size: a frame of 51 bytes, but 3 vertices need 52");
}

TEST(Md3, ErrorsNameByteAndField)
{
    EXPECT_EQ(why(parse_md3(bytes_of("IDP2    "), {})),
              "byte 0: signature: this is no MD3 file: it does not begin with IDP3");
    LoadOptions options;
    options.clip = "run";
    EXPECT_EQ(parse_md3(made_md3(1), options).error().code, ErrorCode::usage);
    Bytes bytes = made_md3(1);
    bytes[108 + 56 + 112 + 72] = 9; // frames of the first surface
    EXPECT_EQ(why(parse_md3(bytes, {})), "byte 348: frame_count: the surface body has 9 frames, the file has 1");
}
