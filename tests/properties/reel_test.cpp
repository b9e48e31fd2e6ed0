/// From an animation into a .reel file and back: what the front door promises, for every codec and awkward shape.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"

using namespace meshreel;

namespace {

constexpr double max_error = 0.01; // model units; the shapes are a few units large

EncodeOptions options_for(const codecs::Codec& codec, Order order = Order::keep)
{
    EncodeOptions options;
    options.codec = std::string(codec.name);
    if (!codec.exact()) options.quality.max_error = max_error;
    options.order = order;
    options.threads = {1};
    return options;
}

void expect_same_appearance(const Appearance& a, const Appearance& b)
{
    ASSERT_EQ(a.attributes.size(), b.attributes.size());
    for (std::size_t i = 0; i < a.attributes.size(); ++i) {
        EXPECT_EQ(a.attributes[i].name, b.attributes[i].name);
        EXPECT_EQ(a.attributes[i].values, b.attributes[i].values);
        EXPECT_EQ(a.attributes[i].indices, b.attributes[i].indices);
    }
    EXPECT_EQ(a.materials, b.materials);
    EXPECT_EQ(a.groups, b.groups);
}

/// All that must come back exactly, and the positions within the bound.
void expect_round_trip(const Animation& original, const Animation& decoded)
{
    EXPECT_EQ(original.triangles, decoded.triangles);
    EXPECT_EQ(original.times_s, decoded.times_s);
    EXPECT_EQ(original.meta.name, decoded.meta.name);
    EXPECT_EQ(original.meta.fps, decoded.meta.fps);
    EXPECT_EQ(original.meta.loop, decoded.meta.loop);
    expect_same_appearance(original.appearance, decoded.appearance);
    ASSERT_EQ(original.positions.size(), decoded.positions.size());
    EXPECT_LE(metrics::max_error(original, decoded), max_error);
}

Animation sample()
{
    return *shapes::generate(*shapes::find("wave"), {.vertices = 400, .frames = 20});
}

class EveryReel : public testing::TestWithParam<codecs::Codec> {};

class EveryLossyReel : public EveryReel {};

INSTANTIATE_TEST_SUITE_P(Registry, EveryLossyReel,
                         testing::ValuesIn(codecs::of_trajectories().begin(), codecs::of_trajectories().end()),
                         [](const auto& row) { return std::string(row.param.name); });

INSTANTIATE_TEST_SUITE_P(Registry, EveryReel, testing::ValuesIn(codecs::all().begin(), codecs::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

} // namespace

TEST_P(EveryReel, GivesBackEveryConnectivityInTheOriginalOrder)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        SCOPED_TRACE(name);
        const auto encoded = encode(animation, options_for(GetParam()));
        ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
        const auto decoded = decode(encoded->bytes);
        ASSERT_TRUE(decoded.ok()) << decoded.error().sentence();
        expect_round_trip(animation, *decoded);
    }
}

TEST_P(EveryReel, GivesBackTheFreeOrderThatAnyoneCanDerive)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        SCOPED_TRACE(name);
        const auto encoded = encode(animation, options_for(GetParam(), Order::free));
        ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
        expect_round_trip(in_free_order(animation), *decode(encoded->bytes));
    }
}

TEST_P(EveryReel, NeedsOnlyTheBaseMeshWhereThatIsShared)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        SCOPED_TRACE(name);
        EncodeOptions options = options_for(GetParam(), Order::base);
        options.base = &animation;
        const auto encoded = encode(animation, options);
        ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
        DecodeOptions reading;
        reading.base = &animation;
        const auto decoded = decode(encoded->bytes, reading);
        ASSERT_TRUE(decoded.ok()) << decoded.error().sentence();
        expect_round_trip(animation, *decoded);
        EXPECT_EQ(decode(encoded->bytes).error().code, ErrorCode::usage);
    }
}

TEST_P(EveryReel, RefusesAnotherBaseMesh)
{
    const Animation animation = test_shapes::torus();
    Animation other = animation;
    std::swap(other.triangles[0], other.triangles[1]);
    EncodeOptions options = options_for(GetParam(), Order::base);
    options.base = &animation;
    DecodeOptions reading;
    reading.base = &other;
    EXPECT_EQ(decode(encode(animation, options)->bytes, reading).error().field, "base");
    options.base = &other;
    EXPECT_EQ(encode(animation, options).error().code, ErrorCode::usage);
}

TEST_P(EveryLossyReel, MeetsTheErrorAskedFor)
{
    const Animation animation = sample();
    EncodeOptions options = options_for(GetParam());
    for (double target : {2.0, 0.3, 0.02}) {
        options.quality = {};
        options.quality.kg = target;
        const auto by_kg = encode(animation, options);
        ASSERT_TRUE(by_kg.ok()) << by_kg.error().sentence();
        EXPECT_LE(metrics::kg_error(animation, *decode(by_kg->bytes)), target);
        EXPECT_GE(by_kg->kg, 0.95 * target); // with components that come and go at once; else 0.97
        options.quality = {};
        options.quality.max_error_relative = target;
        const auto by_distance = encode(animation, options);
        ASSERT_TRUE(by_distance.ok()) << by_distance.error().sentence();
        EXPECT_LE(metrics::max_error_relative(animation, *decode(by_distance->bytes)), target);
    }
}

TEST_P(EveryLossyReel, MeetsTheStedAskedFor)
{
    const Animation animation = sample();
    EncodeOptions options = options_for(GetParam());
    options.quality = {};
    options.quality.sted = 0.02;
    const auto encoded = encode(animation, options);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    EXPECT_LE(metrics::sted_error(animation, *decode(encoded->bytes)), 0.02);
    EXPECT_GE(*encoded->sted, 0.97 * 0.02);
}

TEST_P(EveryLossyReel, MeetsThePsnrAskedFor)
{
    const Animation animation = sample();
    EncodeOptions options = options_for(GetParam());
    options.quality = {};
    options.quality.psnr = 60;
    const auto encoded = encode(animation, options);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    EXPECT_GE(metrics::psnr(animation, *decode(encoded->bytes)), 60.0);
    EXPECT_LE(encoded->psnr, 60.3);
}

TEST_P(EveryLossyReel, FitsIntoTheSizeAskedFor)
{
    EncodeOptions options = options_for(GetParam());
    options.quality = {};
    options.quality.size = 5000;
    const auto encoded = encode(sample(), options);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    EXPECT_LE(encoded->bytes.size(), 5000u);
}

TEST(ExactReel, GivesBackEveryBitThroughTheFrontDoor)
{
    for (Order order : {Order::keep, Order::free}) {
        Animation animation = test_shapes::split_seam();
        animation.positions[4] = -0.0f;
        EncodeOptions options;
        options.codec = "lossless";
        options.order = order;
        const Animation back = *decode(encode(animation, options)->bytes);
        const Animation expected = order == Order::free ? in_free_order(animation) : animation;
        ASSERT_EQ(back.positions.size(), expected.positions.size());
        EXPECT_EQ(0, std::memcmp(back.positions.data(), expected.positions.data(), 4 * back.positions.size()));
    }
}

TEST(ExactReel, HasNoQualityToChoose)
{
    EncodeOptions options;
    options.codec = "lossless";
    options.quality.kg = 0.1;
    EXPECT_EQ(encode(test_shapes::torus(), options).error().code, ErrorCode::usage);
}

TEST_P(EveryReel, WritesTheSameBytesForOneAndTwoThreads)
{
    const Animation animation = sample();
    EncodeOptions options = options_for(GetParam());
    const Bytes one = encode(animation, options)->bytes;
    options.threads = {2};
    EXPECT_EQ(one, encode(animation, options)->bytes);
}

TEST_P(EveryReel, RefusesEveryTruncationAndEveryFlippedByte)
{
    const Bytes reel = encode(test_shapes::split_seam(), options_for(GetParam()))->bytes;
    for (std::size_t size = 0; size < reel.size(); ++size)
        EXPECT_FALSE(decode(ByteView(reel).first(size)).ok()) << size;
    for (std::size_t i = 0; i < reel.size(); ++i) {
        Bytes broken = reel;
        broken[i] ^= 0x55;
        EXPECT_FALSE(decode(broken).ok()) << "byte " << i;
    }
}

TEST(Reel, SaysWhatItHoldsWithoutDecodingPositions)
{
    Animation animation = sample();
    animation.meta.name = "ripple";
    const auto found = info(encode(animation)->bytes);
    ASSERT_TRUE(found.ok()) << found.error().sentence();
    EXPECT_EQ(found->vertices, animation.vertex_count);
    EXPECT_EQ(found->frames, animation.frame_count());
    EXPECT_EQ(found->meta.name, "ripple");
    EXPECT_EQ(found->codec, "reel");
}

TEST(Reel, RefusesQualitiesThatContradictEachOther)
{
    EncodeOptions options;
    options.quality.kg = 0.1;
    options.quality.max_error = 0.1;
    EXPECT_EQ(encode(sample(), options).error().code, ErrorCode::usage);
    options.quality = {};
    options.quality.kg = -1.0;
    EXPECT_EQ(encode(sample(), options).error().code, ErrorCode::usage);
}

TEST(Reel, RefusesAnUnknownCodecAndAnInvalidAnimation)
{
    EncodeOptions options;
    options.codec = "zip";
    EXPECT_EQ(encode(sample(), options).error().code, ErrorCode::usage);
    Animation broken = sample();
    broken.positions[3] = NAN;
    EXPECT_EQ(encode(broken).error().code, ErrorCode::bad_input);
}

TEST(Reel, KeepsATargetWhereOtherMeasuresAreInfinite)
{
    Animation animation = sample();
    std::ranges::fill(animation.positions, 0.0f);
    std::ranges::fill(animation.frame(3), std::numeric_limits<float>::denorm_min()); // KG: a little over nothing
    EncodeOptions options;
    options.quality.psnr = 43;
    const auto encoded = encode(animation, options);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    EXPECT_GE(encoded->psnr, 43.0);
    EXPECT_TRUE(decode(encoded->bytes).ok());
}

TEST_P(EveryLossyReel, RefusesPositionsThatItsFileWouldGiveBackInfinite)
{
    Animation animation = sample();
    for (std::size_t f = 0; f < 10; ++f) animation.frame(f)[1] = std::numeric_limits<float>::max();
    EncodeOptions options = options_for(GetParam());
    options.quality = {};
    options.quality.bases = 1;
    int refused = 0;
    for (const double step : {0.02, 0.03, 0.04, 0.05}) { // of most codecs half of them round up
        options.quality.step = step;
        const auto encoded = encode(animation, options);
        if (encoded.ok()) {
            EXPECT_TRUE(decode(encoded->bytes).ok());
            continue;
        }
        ++refused;
        EXPECT_EQ(encoded.error().code, ErrorCode::missed);
        EXPECT_THAT(encoded.error().sentence(),
                    testing::HasSubstr("positions: decoded, frame 0, vertex 0, y is infinite; "));
    }
    EXPECT_TRUE(refused > 0 || GetParam().name == "reel"); // which rounds towards nothing
}

TEST(Reel, FillsTheSizeAskedFor)
{
    EncodeOptions options;
    options.quality.bpfv = 2;
    const auto encoded = encode(sample(), options);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    EXPECT_LE(encoded->bpfv, 2.0);
    EXPECT_GE(encoded->bpfv, 1.94);
}

TEST(Reel, AHigherEffortIsSmaller)
{
    const Animation cloth = *shapes::generate(*shapes::find("cloth"), {.vertices = 400, .frames = 40});
    EncodeOptions options;
    options.quality.kg = 0.2;
    options.effort = 1;
    const Bytes fast = encode(cloth, options)->bytes;
    options.effort = 9;
    EXPECT_LT(encode(cloth, options)->bytes.size(), fast.size());
    options.effort = 10;
    EXPECT_EQ(encode(cloth, options).error().code, ErrorCode::usage);
}

TEST(Reel, OpensFastForATenthMoreAtMost)
{
    for (const char* name : {"cloth", "walker"}) {
        const Animation animation = *shapes::generate(*shapes::find(name), {.vertices = 900, .frames = 40});
        EncodeOptions options;
        options.quality.kg = 0.2;
        const Bytes usual = encode(animation, options)->bytes;
        options.fast_decode = true;
        const Bytes fast = encode(animation, options)->bytes;
        EXPECT_NE(fast, usual) << name;
        EXPECT_LT(static_cast<double>(fast.size()), 1.1 * static_cast<double>(usual.size())) << name;
    }
}

TEST(Reel, CutsLongAnimationsIntoSegments)
{
    const Animation animation = *shapes::generate(*shapes::find("wave"), {.vertices = 30, .frames = 4500});
    const auto encoded = encode(animation);
    ASSERT_TRUE(encoded.ok()) << encoded.error().sentence();
    EXPECT_LE(metrics::sted_error(animation, *decode(encoded->bytes)), 0.02);
    const auto chunks = info(encoded->bytes)->chunks;
    EXPECT_EQ(std::count_if(chunks.begin(), chunks.end(), [](const auto& chunk) { return chunk.type == "SEGM"; }), 2);
}
