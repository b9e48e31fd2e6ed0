/// Long animations: a segment in memory at a time, and measures of the whole.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"

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

} // namespace

TEST(Segments, FramesThatAreReadGiveTheBytesOfFramesInMemory)
{
    const Animation animation = swimmer(50);
    FailingFrames source(animation, -1);
    const Encoded read = *encode(source, in_segments(20)), held = *encode(animation, in_segments(20));
    EXPECT_EQ(read.bytes, held.bytes);
    EXPECT_EQ(read.kg, held.kg);
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
