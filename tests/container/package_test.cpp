/// What no codec changes goes into a file and comes back bit for bit.
// SPDX-License-Identifier: MIT
#include "meshreel/container/package.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/container/clip.h"

namespace meshreel::container {
namespace {

Bytes bytes_of(const std::vector<float>& values)
{
    Bytes bytes(values.size() * 4);
    for (std::size_t i = 0; i < values.size(); ++i) store_real(values[i], bytes.data() + 4 * i);
    return bytes;
}

/// The attribute after a trip through a chunk's bytes.
Result<Attribute> trip(const Attribute& attribute, const MeshShape& mesh)
{
    MESHREEL_TRY(const Bytes bytes, write_fields(pack_attribute(attribute, mesh)));
    MESHREEL_TRY(const AttributeChunk chunk, read_fields<AttributeChunk>({bytes, 0, "attr"}, {}));
    Budget budget(1u << 24);
    return unpack_attribute(chunk, mesh, budget);
}

void expect_same(const Result<Attribute>& back, const Attribute& attribute)
{
    ASSERT_TRUE(back.ok()) << back.error().sentence();
    EXPECT_EQ(back->name, attribute.name);
    EXPECT_EQ(back->domain, attribute.domain);
    EXPECT_EQ(back->type, attribute.type);
    EXPECT_EQ(back->components, attribute.components);
    EXPECT_EQ(back->normalized, attribute.normalized);
    EXPECT_EQ(back->values, attribute.values);
    EXPECT_EQ(back->indices, attribute.indices);
}

TEST(Attributes, of_every_type_domain_and_width_come_back_bit_for_bit)
{
    const auto triangles = grid(5);
    const MeshShape mesh{25, triangles};
    for (const Scalar type : {Scalar::f32, Scalar::u8, Scalar::u16, Scalar::u32, Scalar::i8, Scalar::i16})
        for (const Domain domain : {Domain::vertex, Domain::corner, Domain::triangle})
            for (const std::uint8_t components : std::initializer_list<std::uint8_t>{1, 3, 16}) {
                const std::size_t elements = domain == Domain::vertex ? 25 : domain == Domain::corner ? 96 : 32;
                const Bytes values = random_bytes(elements * components * scalar_size(type), components);
                const Attribute attribute{"any", domain, type, components, true, values, {}};
                expect_same(trip(attribute, mesh), attribute);
            }
}

TEST(Attributes, of_floats_keep_not_a_number_infinity_and_negative_zero)
{
    const std::vector<Triangle> none;
    const Attribute attribute{
        "x", Domain::vertex, Scalar::f32, 1, false, bytes_of({-0.0f, 0.0f, NAN, -INFINITY, 1e-45f, -3.5f}), {}};
    expect_same(trip(attribute, {6, none}), attribute);
    const Attribute decimals{
        "x", Domain::vertex, Scalar::f32, 1, false, bytes_of({-0.0f, 0.0f, -0.1f, 0.25f, 1e3f, -7.3f}), {}};
    expect_same(trip(decimals, {6, none}), decimals);
}

TEST(Attributes, with_indices_seams_and_elements_without_a_value_come_back)
{
    const auto triangles = grid(6);
    Attribute attribute{"uv0", Domain::corner, Scalar::f32, 2, false, {}, {}};
    std::vector<float> values;
    for (std::uint32_t i = 0; i < 72; ++i)
        values.insert(values.end(), {static_cast<float>(i % 6) * 0.2f, static_cast<float>(i) * 0.01f});
    attribute.values = bytes_of(values);
    for (const Triangle& triangle : triangles)
        for (const std::uint32_t v : triangle)
            attribute.indices.push_back(v == 7 ? 0xffffffffu : triangle[0] % 5 == 0 ? v + 36 : v);
    expect_same(trip(attribute, {36, triangles}), attribute);
    attribute.indices.assign(150, 71);
    expect_same(trip(attribute, {36, triangles}), attribute);
}

TEST(Attributes, survive_degenerate_and_repeated_triangles)
{
    const std::vector<Triangle> triangles = {{0, 0, 0}, {0, 1, 1}, {0, 1, 2}, {0, 1, 2}, {2, 1, 0}, {1, 0, 3}};
    Attribute attribute{"uv0", Domain::corner, Scalar::f32, 1, false, bytes_of({1, 2, 3, 4, 5}), {}};
    for (std::uint32_t c = 0; c < 18; ++c) attribute.indices.push_back(c * 7 % 5);
    expect_same(trip(attribute, {4, triangles}), attribute);
    const Attribute vertices{"w", Domain::vertex, Scalar::f32, 1, false, bytes_of({1, 2, 3, 4}), {}};
    expect_same(trip(vertices, {4, triangles}), vertices);
}

TEST(Attributes, whose_values_repeat_store_each_once)
{
    const auto triangles = grid(40);
    Attribute normals{"normal", Domain::vertex, Scalar::f32, 3, false, {}, {}};
    const Bytes few = random_bytes(12 * 50, 1);
    Random random(2);
    for (int i = 0; i < 1600; ++i) {
        const auto from = few.begin() + static_cast<std::ptrdiff_t>(12 * random.below(50));
        normals.values.insert(normals.values.end(), from, from + 12);
    }
    const AttributeChunk chunk = pack_attribute(normals, {1600, triangles});
    EXPECT_TRUE(chunk.repeated);
    EXPECT_EQ(chunk.distinct_count, 50u);
    EXPECT_LT(write_fields(chunk)->size(), squeeze(normals.values).data.size());
    expect_same(trip(normals, {1600, triangles}), normals);
}

TEST(Attributes, with_places_beyond_the_distinct_values_are_refused)
{
    const std::vector<Triangle> none;
    AttributeChunk chunk;
    chunk.head = {"x", Domain::vertex, Scalar::u8, 1, false, {}, {}};
    chunk.value_count = 2;
    chunk.repeated = true;
    chunk.distinct_count = 1;
    chunk.places = pack_words(std::vector<std::uint32_t>{0, 1}, {2});
    chunk.values = pack_words(std::vector<std::uint32_t>{7}, {1, 1, 1});
    Budget budget(1000);
    EXPECT_EQ(unpack_attribute(chunk, {2, none}, budget).error().sentence(), "places: 1 is beyond the 1 values");
}

TEST(Attributes, on_a_smooth_surface_are_far_smaller_than_plain_zstd)
{
    const auto triangles = grid(60);
    Attribute uv{"uv0", Domain::vertex, Scalar::f32, 2, false, {}, {}};
    std::vector<float> values;
    for (std::uint32_t i = 0; i < 3600; ++i) {
        const float x = static_cast<float>(i % 60) / 59.0f, y = static_cast<float>(i / 60) / 59.0f;
        values.insert(values.end(), {x + 0.3f * y * y, y + 0.2f * x * x});
    }
    uv.values = bytes_of(values);
    const std::size_t plain = squeeze(uv.values).data.size();
    EXPECT_LT(write_fields(pack_attribute(uv, {3600, triangles}))->size(), plain / 2);
    expect_same(trip(uv, {3600, triangles}), uv);
}

std::vector<double> times_back(const std::vector<double>& times_s, double fps)
{
    const Bytes bytes = *write_fields(pack_times(times_s, fps));
    const auto chunk = read_fields<TimeChunk>({bytes, 0, "TIME"}, {});
    Budget budget(1 << 20);
    return *unpack_times(*chunk, static_cast<std::uint32_t>(times_s.size()), budget);
}

TEST(Times, that_are_uniform_take_seventeen_bytes_and_are_exact)
{
    for (const double fps : {24.0, 30.0, 30000.0 / 1001.0, 60.0}) {
        const auto times = uniform_times(1000, fps, 0.125);
        EXPECT_EQ(write_fields(pack_times(times, 0.0))->size(), 17u) << fps;
        EXPECT_EQ(times_back(times, 0.0), times);
    }
}

TEST(Times, of_any_kind_are_exact)
{
    std::vector<double> times = {-1e300};
    Random random(1);
    for (int i = 0; i < 200; ++i) times.push_back(static_cast<double>(i) * (1.0 / 29.97) + 1e-4 * random.uniform());
    EXPECT_EQ(times_back(times, 29.97), times);
    EXPECT_EQ(times_back({5.0}, 0.0), std::vector<double>{5.0});
    std::vector<double> summed = {0.0};
    for (int i = 0; i < 500; ++i) summed.push_back(summed.back() + 1.0 / 30.0);
    EXPECT_EQ(times_back(summed, 30.0), summed);
}

TEST(Package, comes_back_as_it_went_in)
{
    const Clip clip;
    const Bytes bytes = clip.file();
    const auto file = StreamReader::open(bytes);
    ASSERT_TRUE(file.ok()) << file.error().sentence();
    Budget budget(1 << 20);
    EXPECT_EQ(read_header(*file)->coded_vertex_count, 4u);
    EXPECT_EQ(*read_times(*file, clip.header, budget), clip.times_s);
    EXPECT_EQ(read_metadata(*file)->name, "wave");
    const auto appearance = read_appearance(*file, clip.mesh(), budget);
    ASSERT_TRUE(appearance.ok()) << appearance.error().sentence();
    EXPECT_EQ(appearance->materials, clip.appearance.materials);
    EXPECT_EQ(appearance->attributes[0].values, clip.appearance.attributes[0].values);
    EXPECT_EQ(appearance->assets[0].bytes, clip.appearance.assets[0].bytes);
    EXPECT_EQ(read_segments(*file, clip.header)->at(1).first_frame, 2u);
}

TEST(Package, refuses_segments_that_leave_a_gap)
{
    const Bytes bytes = Clip().file();
    const auto file = StreamReader::open(bytes);
    Header header = *read_header(*file);
    header.frame_count = 4;
    EXPECT_EQ(read_segments(*file, header).error().sentence(), "SEGM.frame_count: the segments end at frame 3 of 4");
    header.frame_count = 2;
    EXPECT_THAT(read_segments(*file, header).error().sentence(),
                testing::HasSubstr("frames 2 and 0 more, but frame 2 of 2"));
}

TEST(Package, refuses_an_attribute_that_unpacks_to_more_than_the_memory_allowed)
{
    const Clip clip;
    const Bytes bytes = clip.file();
    Budget budget(5);
    const auto appearance = read_appearance(*StreamReader::open(bytes), clip.mesh(), budget);
    ASSERT_FALSE(appearance.ok());
    EXPECT_THAT(appearance.error().sentence(), testing::HasSubstr("memory limit"));
}

TEST(Package, refuses_a_zstd_frame_that_promises_more_than_it_can_hold)
{
    Squeezed bomb;
    bomb.method = Squeezed::Method::zstd;
    bomb.size = 1ull << 33;
    bomb.kept = squeeze(Bytes(1000)).kept;
    bomb.data = bomb.kept;
    Budget budget(1ull << 40);
    EXPECT_FALSE(unsqueeze(bomb, budget).ok());
    bomb.size = 1001;
    EXPECT_FALSE(unsqueeze(bomb, budget).ok());
    bomb.size = 1000;
    EXPECT_TRUE(unsqueeze(bomb, budget).ok());
}

TEST(Fingerprint, tells_base_meshes_apart)
{
    const auto triangles = grid(3);
    auto other = triangles;
    std::swap(other[0][0], other[0][1]);
    EXPECT_EQ(fingerprint_of(9, triangles), fingerprint_of(9, grid(3)));
    EXPECT_NE(fingerprint_of(9, triangles), fingerprint_of(10, triangles));
    EXPECT_NE(fingerprint_of(9, triangles), fingerprint_of(9, other));
}

} // namespace
} // namespace meshreel::container
