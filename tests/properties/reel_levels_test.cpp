/// Levels of detail: what the front door promises of them.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/meshreel.h"
#include "tests/container/counted_source.h"

using namespace meshreel;

namespace {

Animation jelly()
{
    return *shapes::generate(*shapes::find("jelly"), {.vertices = 1500, .frames = 24});
}

Bytes reel_of(const Animation& animation, Order order = Order::free, std::uint32_t segment = 0)
{
    EncodeOptions options;
    options.order = order;
    options.base = order == Order::base ? &animation : nullptr;
    options.segment = segment;
    options.quality.step = 0.002;
    options.threads = {1};
    return encode(animation, options)->bytes;
}

/// The bits of vertex v's trajectory.
std::vector<float> trajectory_of(const Animation& animation, std::uint32_t v)
{
    std::vector<float> positions;
    for (std::size_t f = 0; f < animation.frame_count(); ++f)
        for (std::size_t c = 0; c < 3; ++c) positions.push_back(animation.frame(f)[3ul * v + c]);
    return positions;
}

/// Vertices of a level by number at level 0; 0xffffffff for one that is not there bit for bit.
std::vector<std::uint32_t> numbers_of(const Animation& level, const Animation& all)
{
    std::map<std::vector<float>, std::uint32_t> number;
    for (std::uint32_t v = all.vertex_count; v-- > 0;) number[trajectory_of(all, v)] = v;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t v = 0; v < level.vertex_count; ++v) {
        const auto found = number.find(trajectory_of(level, v));
        numbers.push_back(found == number.end() ? 0xffffffff : found->second);
    }
    return numbers;
}

} // namespace

TEST(ReelLevels, KeepSomeVerticesBitForBitInTheirOrder)
{
    const Animation original = jelly();
    for (const Order order : {Order::free, Order::keep, Order::base}) {
        const Bytes reel = reel_of(original, order);
        const Animation all = *decode(reel, {.base = &original});
        for (const std::uint32_t level : {1u, 2u}) {
            const auto coarse = decode(reel, {.base = &original, .level = level});
            ASSERT_TRUE(coarse.ok()) << coarse.error().sentence();
            const std::vector<std::uint32_t> numbers = numbers_of(*coarse, all);
            EXPECT_LT(numbers.back(), all.vertex_count);
            EXPECT_TRUE(std::ranges::is_sorted(numbers));
        }
    }
}

TEST(ReelLevels, BeginWithEverything)
{
    const Bytes reel = reel_of(jelly());
    EXPECT_EQ(decode(reel, {.level = 0})->positions, decode(reel)->positions);
    EXPECT_EQ(decode(reel, {.level = 0})->triangles, decode(reel)->triangles);
}

TEST(ReelLevels, HaveEverFewerVerticesAndBytesAndLargerErrors)
{
    const auto all = levels(reel_of(jelly()));
    ASSERT_TRUE(all.ok()) << all.error().sentence();
    ASSERT_EQ(all->size(), 3u);
    EXPECT_EQ(all->front().rms_error, 0.0);
    for (std::size_t n = 1; n < all->size(); ++n) {
        const LevelInfo &fine = (*all)[n - 1], &coarse = (*all)[n];
        EXPECT_LE(4 * coarse.vertices, fine.vertices);
        EXPECT_GE(6 * coarse.vertices, fine.vertices);
        EXPECT_LT(coarse.triangles, fine.triangles);
        EXPECT_LT(coarse.bytes, fine.bytes);
        EXPECT_GT(coarse.rms_error, fine.rms_error);
        EXPECT_GE(coarse.max_error, coarse.rms_error);
        EXPECT_LT(coarse.rms_error, 5.0);
    }
}

TEST(ReelLevels, OfAClosedSurfaceAreClosed)
{
    const Bytes reel = reel_of(jelly());
    for (const std::uint32_t level : {1u, 2u}) {
        const Animation coarse = *decode(reel, {.level = level});
        const Topology topology = describe(coarse.vertex_count, coarse.triangles);
        EXPECT_TRUE(topology.closed_manifold()) << level;
        EXPECT_EQ(topology.euler, 2) << level;
    }
}

TEST(ReelLevels, NeedOnlyTheBeginningOfASegment)
{
    const Bytes reel = reel_of(jelly());
    const Info what = *info(reel);
    ASSERT_EQ(what.level_bytes.size(), 3u);
    for (const std::uint32_t level : {1u, 2u}) {
        CountedSource file(reel);
        const auto parts = decode(file, {.level = level});
        ASSERT_TRUE(parts.ok()) << parts.error().sentence();
        EXPECT_EQ(parts->positions, decode(reel, {.level = level})->positions);
        EXPECT_LE(file.fetched, what.level_bytes[level]);
    }
}

TEST(ReelLevels, ComeOutOfAFileThatHasNotArrivedYet)
{
    const Bytes reel = reel_of(jelly());
    const std::vector<std::uint64_t> bytes = info(reel)->level_bytes;
    for (const std::uint32_t level : {1u, 2u}) {
        MemorySource enough(ByteView(reel).first(bytes[level]));
        const auto coarse = decode(enough, {.level = level});
        ASSERT_TRUE(coarse.ok()) << coarse.error().sentence();
        EXPECT_EQ(coarse->positions, decode(reel, {.level = level})->positions);
        EXPECT_FALSE(decode(enough, {.level = level - 1}).ok());
    }
    for (std::size_t size = 0; size < bytes[2] - 100; size += 7) { // index and tail, which are not needed, are less
        MemorySource part(ByteView(reel).first(size));
        ASSERT_FALSE(decode(part, {.level = 2}).ok()) << size;
    }
}

TEST(ReelLevels, AreTheSameOverAllSegments)
{
    const Animation original = jelly();
    for (const std::uint32_t segment : {one_segment, 9u}) {
        const Bytes reel = reel_of(original, Order::free, segment);
        const Animation all = *decode(reel);
        MemorySource file(reel);
        const auto coarse = decode(file, {.level = 2});
        ASSERT_TRUE(coarse.ok()) << coarse.error().sentence();
        EXPECT_EQ(coarse->frame_count(), 24u);
        EXPECT_FALSE(std::ranges::count(numbers_of(*coarse, all), 0xffffffff));
        const Animation some = *decode(reel, {.frames = {10, 20, 5}, .level = 2});
        EXPECT_EQ(some.triangles, coarse->triangles);
        EXPECT_TRUE(std::ranges::equal(some.frame(1), coarse->frame(15)));
    }
}

TEST(ReelLevels, MoveAtAnyRate)
{
    const Bytes reel = reel_of(jelly());
    const Animation stored = *decode(reel, {.level = 1}), fine = *decode(reel, {.fps = 50.0, .level = 1});
    EXPECT_EQ(fine.frame_count(), 47u);
    EXPECT_TRUE(std::ranges::equal(fine.frame(10), stored.frame(5)));
}

TEST(ReelLevels, AreTheSameForAnyNumberOfThreads)
{
    const Bytes reel = reel_of(jelly());
    const Animation one = *decode(reel, {.level = 1, .threads = {1}}),
                    three = *decode(reel, {.level = 1, .threads = {3}});
    EXPECT_EQ(one.positions, three.positions);
    EXPECT_EQ(one.triangles, three.triangles);
}

TEST(ReelLevels, CarryWhatBelongsToTheirVerticesAndTriangles)
{
    Animation original = jelly();
    Attribute number{"number", Domain::vertex, Scalar::u16, 1, false, {}, {}},
        material{"material", Domain::triangle, Scalar::u32, 1, false, {}, {}};
    for (std::uint32_t v = 0; v < original.vertex_count; ++v)
        number.values.insert(number.values.end(), {static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(v >> 8)});
    material.values = {0, 0, 0, 0, 1, 0, 0, 0};
    for (std::size_t t = 0; t < original.triangles.size(); ++t) material.indices.push_back(t < 100 ? 0 : 1);
    original.appearance.attributes = {number, material};
    original.appearance.materials = {"skin", "cloth"};
    const Bytes reel = reel_of(original, Order::keep);
    const Animation coarse = *decode(reel, {.level = 1});
    ASSERT_TRUE(validate(coarse).ok());
    const std::vector<std::uint32_t> numbers = numbers_of(coarse, *decode(reel));
    const Attribute& kept = *coarse.appearance.find("number");
    for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_EQ(kept.values[2 * i] + 256 * kept.values[2 * i + 1], numbers[i]);
    EXPECT_EQ(coarse.appearance.find("material")->indices.size(), coarse.triangles.size());
    EXPECT_EQ(coarse.appearance.materials, original.appearance.materials);
}

TEST(ReelLevels, HaveAValueForEveryCornerWhereTheFileHas)
{
    Animation original = jelly();
    Attribute shade{"shade", Domain::corner, Scalar::u8, 1, false, Bytes(3 * original.triangles.size()), {}};
    for (std::size_t c = 0; c < shade.values.size(); ++c)
        shade.values[c] = static_cast<std::uint8_t>(original.triangles[c / 3][c % 3]);
    original.appearance.attributes = {shade};
    const auto coarse = decode(reel_of(original), {.level = 1});
    ASSERT_TRUE(coarse.ok()) << coarse.error().sentence();
    EXPECT_EQ(coarse->appearance.find("shade")->values.size(), 3 * coarse->triangles.size());
}

TEST(ReelLevels, KeepTheirSeams)
{
    Animation original = jelly();
    Attribute uv{"uv0", Domain::corner, Scalar::u8, 1, false, {1, 2}, {}}; // one value on each side of a plane
    for (const Triangle& t : original.triangles)
        for (std::size_t i = 0; i < 3; ++i) uv.indices.push_back(original.frame(0)[3ul * t[0]] < 0 ? 0 : 1);
    original.appearance.attributes = {uv};
    const Animation coarse = *decode(reel_of(original), {.level = 1});
    const Attribute& kept = *coarse.appearance.find("uv0");
    std::array<std::size_t, 2> wholly{};
    for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
        const std::uint32_t value = kept.indices[3 * t];
        if (value == kept.indices[3 * t + 1] && value == kept.indices[3 * t + 2]) ++wholly[value];
    }
    EXPECT_EQ(wholly[0] + wholly[1], coarse.triangles.size()); // no triangle reaches across the seam
    EXPECT_GT(std::min(wholly[0], wholly[1]), coarse.triangles.size() / 4);
}

TEST(ReelLevels, OfWhateverShapeAreValid)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const Bytes reel = reel_of(animation);
        const auto all = levels(reel);
        ASSERT_TRUE(all.ok()) << name << ": " << all.error().sentence();
        for (std::uint32_t level = 1; level < all->size(); ++level)
            EXPECT_TRUE(decode(reel, {.level = level}).ok()) << name;
    }
}

TEST(ReelLevels, AreRefusedBeyondTheLastAndByCodecsThatHaveNone)
{
    const Animation original = jelly();
    EXPECT_EQ(decode(reel_of(original), {.level = 3}).error().sentence(),
              "level: there is no level 3; the coarsest is 2");
    EncodeOptions options;
    options.codec = "coddyac";
    options.quality.step = 0.01;
    const Bytes reel = encode(original, options)->bytes;
    MemorySource file(reel);
    const Error whole = decode(reel, {.level = 1}).error(), parts = decode(file, {.level = 1}).error();
    EXPECT_EQ(whole.code, ErrorCode::usage);
    EXPECT_EQ(whole.sentence(), "level: the codec coddyac has no levels of detail");
    EXPECT_EQ(parts.sentence(), whole.sentence());
    EXPECT_EQ(levels(reel)->size(), 1u);
}
