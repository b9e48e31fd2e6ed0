/// Threads change nothing: neither a call's own, however many, nor those of other calls beside it.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/player/player.h"

using namespace meshreel;

namespace {

Animation moving(std::uint32_t vertex_count)
{
    return *shapes::generate(*shapes::find("wave"), {.vertices = vertex_count, .frames = 24});
}

Bytes encoded(const codecs::Codec& codec, const Animation& a, unsigned threads)
{
    EncodeOptions options;
    options.codec = codec.name;
    if (!codec.exact()) options.quality.kg = 0.5;
    options.effort = 3;
    options.segment = 10;
    options.threads = {threads};
    return encode(a, options)->bytes;
}

Animation decoded(const Bytes& reel, unsigned threads, std::uint32_t level = 0)
{
    DecodeOptions options;
    options.threads = {threads};
    options.level = level;
    return *decode(reel, options);
}

bool same(const Animation& a, const Animation& b)
{
    return a.triangles == b.triangles && a.positions.size() == b.positions.size() &&
           std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(float)) == 0;
}

/// Runs all of them at once, each on a thread of its own, a few times over.
void at_once(const std::vector<std::function<void()>>& calls)
{
    std::vector<std::thread> all;
    for (const auto& call : calls)
        all.emplace_back([&call] {
            for (int i = 0; i < 3; ++i) call();
        });
    for (std::thread& thread : all) thread.join();
}

class EveryCodecThreads : public testing::TestWithParam<codecs::Codec> {};

INSTANTIATE_TEST_SUITE_P(Registry, EveryCodecThreads, testing::ValuesIn(codecs::all().begin(), codecs::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

} // namespace

TEST_P(EveryCodecThreads, OneTwoAndEightThreadsWriteTheSameBytes)
{
    const Animation a = moving(150);
    const Bytes one = encoded(GetParam(), a, 1);
    EXPECT_EQ(encoded(GetParam(), a, 2), one);
    EXPECT_EQ(encoded(GetParam(), a, 8), one);
}

TEST_P(EveryCodecThreads, OneTwoAndEightThreadsReadTheSameBits)
{
    const Bytes reel = encoded(GetParam(), moving(150), 2);
    const std::uint32_t levels = GetParam().detail != nullptr ? 2 : 1;
    for (std::uint32_t level = 0; level < levels; ++level) {
        const Animation one = decoded(reel, 1, level);
        EXPECT_TRUE(same(decoded(reel, 2, level), one));
        EXPECT_TRUE(same(decoded(reel, 8, level), one));
    }
}

TEST(Threads, DecodersAtOnceDoNotKnowEachOther)
{
    std::vector<Bytes> reels;
    std::vector<Animation> alone;
    for (const codecs::Codec& codec : codecs::all()) {
        reels.push_back(encoded(codec, moving(120 + 10 * static_cast<std::uint32_t>(reels.size())), 1));
        alone.push_back(decoded(reels.back(), 1));
    }
    std::vector<int> wrong(reels.size());
    std::vector<std::function<void()>> calls;
    for (std::size_t i = 0; i < reels.size(); ++i)
        calls.emplace_back([&, i] {
            wrong[i] += !same(decoded(reels[i], 1 + static_cast<unsigned>(i % 2)), alone[i]);
            wrong[i] += !info(reels[i]).ok() + !explain(reels[i]).ok();
        });
    at_once(calls);
    EXPECT_EQ(wrong, std::vector<int>(reels.size()));
}

TEST(Threads, EncodersAtOnceDoNotKnowEachOther)
{
    const std::span<const codecs::Codec> all = codecs::all();
    std::vector<Bytes> alone;
    for (const codecs::Codec& codec : all) alone.push_back(encoded(codec, moving(80), 1));
    std::vector<int> wrong(all.size());
    std::vector<std::function<void()>> calls;
    for (std::size_t i = 0; i < all.size(); ++i)
        calls.emplace_back([&, i] { wrong[i] += encoded(all[i], moving(80), 2) != alone[i]; });
    at_once(calls);
    EXPECT_EQ(wrong, std::vector<int>(all.size()));
}

TEST(Threads, PlayersOfOneFileAtOnceDoNotKnowEachOther)
{
    const Bytes reel = encoded(*codecs::find("reel"), moving(150), 1);
    const Animation whole = decoded(reel, 1);
    std::vector<int> wrong(3);
    std::vector<std::function<void()>> calls;
    for (std::size_t i = 0; i < wrong.size(); ++i)
        calls.emplace_back([&, i] {
            auto player = *player::Player::open(reel);
            std::vector<float> frame(3ul * whole.vertex_count);
            for (std::size_t f = i; f < whole.frame_count(); f += 3) {
                player.seek_frame(f);
                player.pose(frame);
                for (std::size_t c = 0; c < frame.size(); ++c)
                    wrong[i] += !(std::abs(frame[c] - whole.frame(f)[c]) < 1e-4f);
            }
        });
    at_once(calls);
    EXPECT_EQ(wrong, std::vector<int>(wrong.size()));
}
