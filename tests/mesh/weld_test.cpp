/// Vertices with identical trajectories are found, and only those.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/mesh/weld.h"

using namespace meshreel;

namespace {

/// V vertices whose trajectories are drawn from `kinds` different ones.
Animation repeated(std::uint32_t vertices, std::size_t frames, std::uint64_t kinds)
{
    Animation animation;
    animation.vertex_count = vertices;
    animation.times_s = uniform_times(frames, 25.0);
    Random random(7);
    std::vector<std::uint64_t> kind(vertices);
    for (auto& k : kind) k = random.below(kinds);
    for (std::size_t f = 0; f < frames; ++f)
        for (std::uint32_t v = 0; v < vertices; ++v) {
            Random values(kind[v] * 1000 + f / 2);
            for (int i = 0; i < 3; ++i) animation.positions.push_back(static_cast<float>(values.uniform()));
        }
    return animation;
}

bool move_as_one(const Animation& animation, std::uint32_t a, std::uint32_t b)
{
    for (std::size_t f = 0; f < animation.frame_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            if (animation.frame(f)[3ul * a + i] != animation.frame(f)[3ul * b + i]) return false;
    return true;
}

} // namespace

TEST(Weld, ClassesAreExactlyTheEqualTrajectoriesNumberedByFirstOccurrence)
{
    const Animation animation = repeated(120, 5, 40);
    const Weld welded = weld(animation);
    for (std::uint32_t a = 0; a < 120; ++a)
        for (std::uint32_t b = 0; b < 120; ++b)
            EXPECT_EQ(welded.unique_of[a] == welded.unique_of[b], move_as_one(animation, a, b));
    for (std::uint32_t w = 0; w < welded.unique_count(); ++w) EXPECT_EQ(welded.unique_of[welded.first_of[w]], w);
    EXPECT_TRUE(std::is_sorted(welded.first_of.begin(), welded.first_of.end()));
}

TEST(Weld, CollidingHashesDoNotChangeTheResult)
{
    const Animation animation = repeated(500, 6, 90);
    const Weld good = weld(animation);
    for (std::uint64_t mask : {0ull, 1ull, 7ull}) {
        const Weld bad = weld(animation, WeldOptions{{}, mask});
        EXPECT_EQ(good.unique_of, bad.unique_of);
        EXPECT_EQ(good.first_of, bad.first_of);
    }
}

TEST(Weld, TheResultDoesNotDependOnTheNumberOfThreads)
{
    const Animation animation = repeated(20000, 4, 9000);
    EXPECT_EQ(weld(animation, Threads{1}).unique_of, weld(animation, Threads{3}).unique_of);
}

TEST(Weld, ZerosOfDifferentSignStayApart)
{
    Animation animation;
    animation.vertex_count = 3;
    animation.positions = {0.0f, 0, 0, -0.0f, 0, 0, 0.0f, 0, 0};
    animation.times_s = {0.0};
    EXPECT_EQ(weld(animation).unique_of, (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(Weld, TheDoubledVerticesOfASeamBecomeOne)
{
    // 11 x 7 vertices, the last column on the first.
    const Weld welded = weld(test_shapes::split_seam());
    EXPECT_EQ(welded.unique_count(), 70u);
    for (std::uint32_t row = 0; row < 7; ++row) EXPECT_EQ(welded.unique_of[11 * row], welded.unique_of[11 * row + 10]);
}

TEST(Weld, VerticesThatMeetInOneFrameOnlyStayApart)
{
    Animation animation;
    animation.vertex_count = 2;
    animation.positions = {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 4};
    animation.times_s = {0.0, 1.0};
    EXPECT_EQ(weld(animation).unique_count(), 2u);
}
