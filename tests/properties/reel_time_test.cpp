/// Frames by their number and at any rate: what the front door promises about time, for every codec.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"
#include "tests/container/counted_source.h"

using namespace meshreel;

namespace {

class EveryReelInTime : public testing::TestWithParam<codecs::Codec> {
protected:
    static Animation wave()
    {
        return *shapes::generate(*shapes::find("wave"), {.vertices = 60, .frames = 40, .fps = 25});
    }
    static Bytes reel_of(const Animation& animation, std::uint32_t segment)
    {
        EncodeOptions options;
        options.codec = std::string(GetParam().name);
        options.segment = segment;
        if (!GetParam().exact()) options.quality.max_error_relative = 0.05;
        options.threads = {1};
        return encode(animation, options)->bytes;
    }
    static Animation at_rate(const Bytes& reel, double fps, io::FrameRange frames = {})
    {
        return *decode(reel, {.frames = frames, .fps = fps});
    }
};

bool same_frame(const Animation& a, std::size_t f, const Animation& b, std::size_t g)
{
    return std::ranges::equal(a.frame(f), b.frame(g));
}

double largest_step(const Animation& animation, std::size_t f)
{
    double largest = 0;
    for (std::size_t i = 0; i < animation.frame(f).size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(animation.frame(f + 1)[i]) - animation.frame(f)[i]));
    return largest;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryReelInTime, testing::ValuesIn(codecs::all().begin(), codecs::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

} // namespace

TEST_P(EveryReelInTime, IsCutIntoSegmentsOfNoMoreThanTheFramesAskedFor)
{
    const auto chunks = info(reel_of(wave(), 12))->chunks;
    EXPECT_EQ(std::ranges::count(chunks, "SEGM", &Info::Chunk::type), 4);
}

TEST_P(EveryReelInTime, GivesAnyFramesBitForBitAsAmongAll)
{
    const Bytes reel = reel_of(wave(), 12);
    const Animation all = *decode(reel);
    const Animation some = *decode(reel, {.frames = {5, 35, 10}});
    ASSERT_EQ(some.frame_count(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_frame(some, i, all, 5 + 10 * i));
    EXPECT_EQ(some.times_s[1], all.times_s[15]);
    EXPECT_EQ(some.meta.fps, all.meta.fps / 10);
}

TEST_P(EveryReelInTime, GivesTheSameFramesFromAFileReadInParts)
{
    const Bytes reel = reel_of(wave(), 12);
    for (const io::FrameRange frames : {io::FrameRange{}, io::FrameRange{20, 25, 1}}) {
        MemorySource file(reel);
        const auto parts = decode(file, {.frames = frames});
        ASSERT_TRUE(parts.ok()) << parts.error().sentence();
        EXPECT_EQ(parts->positions, decode(reel, {.frames = frames})->positions);
    }
}

TEST_P(EveryReelInTime, ReadsNoSegmentThatTheFramesDoNotNeed)
{
    const Bytes reel = reel_of(wave(), 4);
    std::uint64_t segments = 0, largest = 0;
    const Info what = *info(reel);
    for (const Info::Chunk& chunk : what.chunks)
        if (chunk.type == "SEGM") {
            segments += chunk.size;
            largest = std::max(largest, chunk.size);
        }
    CountedSource file(reel);
    ASSERT_TRUE(decode(file, {.frames = {17, 17, 1}}).ok());
    EXPECT_LE(file.fetched, reel.size() - segments + largest + 4 * 24); // and looks at the heads of some
}

TEST_P(EveryReelInTime, AtAnotherRateGoesExactlyThroughTheStoredFrames)
{
    const Animation original = wave();
    for (const std::uint32_t segment : {12u, one_segment}) {
        const Bytes reel = reel_of(original, segment);
        const Animation stored = *decode(reel), sixty = at_rate(reel, 60);
        EXPECT_EQ(sixty.meta.fps, 60.0);
        ASSERT_EQ(sixty.frame_count(), 94u); // 39 / 25 of a second
        for (std::size_t f = 0; f < 40; f += 5) EXPECT_TRUE(same_frame(sixty, f / 5 * 12, stored, f)) << f;
        EXPECT_EQ(at_rate(reel, 25).positions, stored.positions);
    }
}

TEST_P(EveryReelInTime, MovesSmoothlyAcrossTheBordersOfSegments)
{
    const Animation original = wave();
    const Animation cut = at_rate(reel_of(original, 12), 200), whole = at_rate(reel_of(original, one_segment), 200);
    ASSERT_EQ(cut.frame_count(), whole.frame_count());
    const double tolerance = 2 * 0.0005 * body_diagonal(original); // of the encoder, in both
    for (std::size_t f = 0; f + 1 < cut.frame_count(); ++f)
        EXPECT_LE(largest_step(cut, f), largest_step(whole, f) + tolerance) << f;
}

TEST_P(EveryReelInTime, OfALoopTurnsRoundWithoutAJump)
{
    Animation loop = wave();
    loop.meta.loop = true;
    for (const std::uint32_t segment : {12u, one_segment}) {
        const Animation fine = at_rate(reel_of(loop, segment), 100);
        ASSERT_EQ(fine.frame_count(), 160u); // 40 / 25 of a second
        EXPECT_TRUE(same_frame(fine, 0, *decode(reel_of(loop, segment)), 0));
        EXPECT_EQ(fine.times_s.back(), 1.59);
        EXPECT_FALSE(same_frame(fine, 159, fine, 156)); // it is on its way to the first frame
    }
}

TEST_P(EveryReelInTime, ShowsAPartAsAmongAllAtTheSameRate)
{
    const Bytes reel = reel_of(wave(), 12);
    const Animation all = at_rate(reel, 50), part = at_rate(reel, 50, {10, 14, 1});
    ASSERT_EQ(part.frame_count(), 9u);
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t j = 0; j < part.frame(i).size(); ++j) // their times are the same up to rounding
            ASSERT_NEAR(part.frame(i)[j], all.frame(20 + i)[j], 1e-6) << i;
}

TEST(ReelTime, RefusesRatesAndFramesThatMakeNoSense)
{
    const Bytes reel = encode(*shapes::generate(*shapes::find("wave"), {.vertices = 30, .frames = 5}))->bytes;
    for (const double fps : {0.0, -1.0, HUGE_VAL, std::nan(""), 1e12})
        EXPECT_EQ(decode(reel, {.fps = fps}).error().code, ErrorCode::usage) << fps;
    EXPECT_EQ(decode(reel, {.frames = {5, 9, 1}}).error().code, ErrorCode::usage);
    EXPECT_EQ(decode(reel, {.frames = {0, 4, 2}, .fps = 60}).error().code, ErrorCode::usage);
}
