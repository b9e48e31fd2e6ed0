/// Long animations: a segment in memory at a time, and measures of the whole.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"
#include "meshreel/segmenting.h"

using namespace meshreel;

namespace {

Animation swimmer(std::uint32_t frames)
{
    return *shapes::generate(*shapes::find("swimmer"), {.vertices = 300, .frames = frames});
}

EncodeOptions in_segments(std::uint32_t frames)
{
    EncodeOptions options;
    options.segment = frames;
    options.effort = 2;
    options.quality.sted = 0.02;
    return options;
}

/// Copies the frames asked for, and fails from the call with that number on.
class FailingFrames : public FrameSource {
public:
    FailingFrames(const Animation& animation, int good_calls) : held_(animation), good_calls_(good_calls)
    {
        still_ = animation;
        still_.positions = {};
    }
    const Animation& still() const override { return still_; }
    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override
    {
        if (calls++ == good_calls_) return Error{ErrorCode::io, "the cable is out", {}, {}, {}};
        MESHREEL_TRY(const MatrixView<const float> frames, held_.frames(first, count, room));
        room = Matrix<float>(count, frames.cols);
        std::ranges::copy(frames.values(), room.values.begin());
        return MatrixView<const float>(room.view());
    }
    int calls = 0;

private:
    HeldFrames held_;
    Animation still_;
    int good_calls_;
};

/// Frames of one shape, then of another, of the same triangles.
Animation one_then_other(const Animation& first, const Animation& second)
{
    Animation both = first;
    both.positions.insert(both.positions.end(), second.positions.begin(), second.positions.end());
    both.times_s = uniform_times(first.frame_count() + second.frame_count(), 25.0);
    return both;
}

Animation moving(const char* shape, std::uint32_t frames, std::uint64_t seed)
{
    return *shapes::generate(*shapes::find(shape), {.vertices = 400, .frames = frames, .seed = seed});
}

/// The numbers of frames of a file's segments, as a reader meets them.
std::vector<std::uint64_t> lengths_of(const Bytes& reel)
{
    std::vector<std::uint64_t> lengths;
    const std::string text = *explain(reel);
    for (std::size_t at = text.find("SEGM.frame_count"); at != std::string::npos;
         at = text.find("SEGM.frame_count", at + 1))
        lengths.push_back(std::stoull(text.substr(text.find_first_of("0123456789", text.find("  ", at + 16)))));
    return lengths;
}

Encoded at_kg(const Animation& animation, std::uint32_t segment)
{
    EncodeOptions options = in_segments(segment);
    options.quality = {};
    options.quality.kg = 0.2;
    return *encode(animation, options);
}

} // namespace

TEST(Segments, FramesThatAreReadGiveTheBytesOfFramesInMemory)
{
    const Animation animation = swimmer(50);
    FailingFrames source(animation, -1);
    const Encoded read = *encode(source, in_segments(20)), held = *encode(animation, in_segments(20));
    EXPECT_EQ(read.bytes, held.bytes);
    EXPECT_EQ(read.kg, held.kg);
}

namespace {

/// Takes so many writes, then none.
class FullDisk : public MemorySpool {
public:
    explicit FullDisk(int writes) : left_(writes) {}

    Status write(ByteView bytes) override
    {
        if (--left_ < 0) return Error{ErrorCode::io, "the disk is full", {}, {}, {}};
        return MemorySpool::write(bytes);
    }

private:
    int left_;
};

} // namespace

TEST(Segments, ASpoolTakesTheBytesThatMemoryWouldAndItsFailureIsTold)
{
    const Animation animation = swimmer(50);
    for (const char* codec : {"reel", "lossless"}) {
        HeldFrames frames(animation);
        EncodeOptions options = in_segments(20);
        options.codec = codec;
        options.quality = {};
        if (options.codec == "reel") options.quality.step = 1e-3;
        MemorySpool spool;
        const Reached reached = *encode(frames, spool, options);
        EXPECT_EQ(reached.file_bytes, spool.size());
        EXPECT_EQ(std::move(spool).take(), encode(animation, options)->bytes);
        for (const int writes : {0, 1, 10}) {
            FullDisk disk(writes);
            const auto failed = encode(frames, disk, options);
            EXPECT_EQ(failed.ok() ? "it worked" : failed.error().message, "the disk is full");
        }
    }
}

TEST(Segments, WhatAnEncodingSaysIsWhatTheMeasuresSayOfTheDecodedFile)
{
    const Animation animation = swimmer(50);
    for (const Order order : {Order::keep, Order::free}) {
        EncodeOptions options = in_segments(20);
        options.order = order;
        const Encoded encoded = *encode(animation, options);
        const Animation decoded = *decode(encoded.bytes),
                        original = order == Order::keep ? animation : in_free_order(animation);
        EXPECT_EQ(encoded.max_error, metrics::max_error(original, decoded));
        EXPECT_NEAR(encoded.kg / metrics::kg_error(original, decoded), 1.0, 1e-12);
        EXPECT_NEAR(*encoded.sted / metrics::sted_error(original, decoded), 1.0, 1e-12);
        EXPECT_LE(*encoded.sted, 0.02);
        EXPECT_GE(*encoded.sted, 0.97 * 0.02);
    }
}

TEST(Segments, FramesComeOutOfAFileOneSegmentAtATimeAsDecodeGivesThem)
{
    const Animation animation = swimmer(50);
    const Bytes reel = encode(animation, in_segments(20))->bytes;
    MemorySource file(reel);
    const auto source = open_frames(file);
    ASSERT_TRUE(source.ok()) << source.error().sentence();
    const Animation decoded = *decode(reel);
    EXPECT_EQ((*source)->still().times_s, decoded.times_s);
    Matrix<float> room;
    for (const std::size_t first : {0u, 30u, 7u, 47u}) {
        const MatrixView<const float> frames = *(*source)->frames(first, 3, room);
        EXPECT_TRUE(std::equal(frames.data, frames.data + frames.rows * frames.cols, decoded.frame(first).data()));
    }
    Bytes damaged = reel;
    damaged[reel.size() / 2] ^= 1;
    MemorySource bad(damaged);
    const auto opened = open_frames(bad);
    ASSERT_TRUE(!opened.ok() || !(*opened)->frames(0, 50, room).ok());
}

TEST(Segments, AnyReadThatFailsEndsTheEncodingWithItsError)
{
    const Animation animation = swimmer(30);
    EncodeOptions options = in_segments(10);
    options.quality = {};
    options.quality.bases = 4;
    options.quality.step = 1e-3;
    FailingFrames all(animation, -1);
    ASSERT_TRUE(encode(all, options).ok());
    for (int good = 0; good < all.calls; ++good) {
        FailingFrames source(animation, good);
        const auto encoded = encode(source, options);
        ASSERT_FALSE(encoded.ok()) << good;
        EXPECT_EQ(encoded.error().message, "the cable is out");
    }
}

TEST(Segments, TwoMotionsThatHaveNothingInCommonAreCutWhereOneEnds)
{
    const Animation both = one_then_other(moving("wave", 173, 1), moving("swimmer", 120, 1));
    const Encoded cut = at_kg(both, 0), whole = at_kg(both, one_segment);
    EXPECT_EQ(lengths_of(cut.bytes), (std::vector<std::uint64_t>{173, 120}));
    EXPECT_LT(cut.bytes.size(), 0.8 * static_cast<double>(whole.bytes.size()));
}

TEST(Segments, AMotionThatComesBackIsNotCut)
{
    const Animation turn = moving("walker", 150, 1);
    const Animation again = one_then_other(one_then_other(turn, turn), turn);
    const Encoded chosen = at_kg(again, 0), cut = at_kg(again, 150);
    EXPECT_EQ(lengths_of(chosen.bytes), (std::vector<std::uint64_t>{450}));
    EXPECT_LT(chosen.bytes.size(), 0.7 * static_cast<double>(cut.bytes.size()));
}

TEST(Segments, OnesThatAreTooLongAreDividedEvenlyAndOthersLeft)
{
    const std::vector<FrameSpan> whole{{0, 7}, {7, 3}};
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    for (const FrameSpan& part : divided(whole, 3)) parts.emplace_back(part.first, part.count);
    EXPECT_EQ(parts, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}, {2, 2}, {4, 3}, {7, 3}}));
}

TEST(Segments, AreShorterWhereComponentsMayBeAsManyAsNumbersOfATrajectory)
{
    for (std::uint32_t W : {50'000u, 150'000u, 300'000u}) {
        EXPECT_LT(longest_rich_segment(W), longest_segment(W, false));
        EXPECT_LE((12.0 + 3 * 16) * static_cast<double>(longest_rich_segment(W)) * W, 1.2e9);
    }
}
