/// The player against the exact decode: every codec, every shape, every kernel, between frames and across segments.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/test_shapes.h"
#include "tests/player/fixture.h"

using namespace meshreel;
using player::Player;

namespace {

constexpr double promised = 1e-6; // body diagonals

class PlayerOfEveryCodec : public testing::TestWithParam<codecs::Codec> {
protected:
    static EncodeOptions options()
    {
        EncodeOptions options;
        options.codec = GetParam().name;
        return options;
    }
};

INSTANTIATE_TEST_SUITE_P(Registry, PlayerOfEveryCodec,
                         testing::ValuesIn(codecs::of_trajectories().begin(), codecs::of_trajectories().end()),
                         [](const auto& row) { return std::string(row.param.name); });

Animation wave()
{
    return shape("wave", {.vertices = 150, .frames = 40});
}

} // namespace

TEST_P(PlayerOfEveryCodec, StaysWithinAMillionthOfTheBodyDiagonalOfTheExactDecode)
{
    for (const shapes::Shape& row : shapes::all()) {
        const Bytes reel = reel_of(*shapes::generate(row, {.vertices = 400, .frames = 30}), options());
        EXPECT_LE(farthest(*decode(reel), played(*Player::open(reel))), promised) << row.name;
    }
}

TEST_P(PlayerOfEveryCodec, StaysAsCloseBetweenTheFramesAndAcrossTheBordersOfSegments)
{
    EncodeOptions segmented = options();
    segmented.segment = 12;
    const Bytes reel = reel_of(wave(), segmented);
    const Animation exact = *decode(reel, {.fps = 67});
    Player player = *Player::open(reel);
    EXPECT_LE(farthest(exact, played_at(player, exact.times_s)), promised);
}

TEST(Player, StaysAsCloseWithEveryKernelThatTheMachineHas)
{
    const Bytes reel = reel_of(shape("walker", {.vertices = 500, .frames = 20}));
    const Animation exact = *decode(reel);
    for (const player::Kernel& kernel : player::kernels())
        EXPECT_LE(farthest(exact, played(*Player::open(reel, {.kernel = &kernel}))), promised) << kernel.name;
}

TEST(Player, StaysAsCloseWithHundredsOfComponents)
{
    const Bytes reel = reel_of(shape("cloth", {.vertices = 900, .frames = 120}), with_bases(300));
    EXPECT_LE(farthest(*decode(reel), played(*Player::open(reel))), promised);
}

TEST(Player, RoundsOnceWhereTheBodyIsFarFromTheOrigin)
{
    Animation far = wave();
    const float away = 256.0f * static_cast<float>(body_diagonal(far));
    for (float& x : far.positions) x += away;
    const Bytes reel = reel_of(far);
    const Animation exact = *decode(reel);
    const std::vector<float> posed = played(*Player::open(reel));
    for (std::size_t i = 0; i < posed.size(); ++i)
        ASSERT_LE(std::abs(posed[i] - exact.positions[i]), std::nextafter(posed[i], HUGE_VALF) - posed[i]);
}

TEST(Player, ShowsEveryKindOfMeshWithItsWeldedAndIsolatedVertices)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const Bytes reel = reel_of(animation);
        const Animation exact = *decode(reel);
        const Player player = *Player::open(reel);
        EXPECT_EQ(player.triangles(), exact.triangles) << name;
        EXPECT_LE(farthest(exact, played(player)), promised) << name;
    }
}

TEST(Player, PosesWeldedVerticesOnceWhereTrianglesShareNone)
{
    const Animation whole = wave();
    Animation split = whole;
    split.vertex_count = static_cast<std::uint32_t>(3 * whole.triangles.size());
    split.positions.clear();
    split.appearance = {};
    for (std::size_t f = 0; f < whole.frame_count(); ++f)
        for (const Triangle& triangle : whole.triangles)
            for (const std::uint32_t v : triangle)
                split.positions.insert(split.positions.end(), &whole.frame(f)[3 * v], &whole.frame(f)[3 * v] + 3);
    for (std::uint32_t t = 0; t < split.triangles.size(); ++t) split.triangles[t] = {3 * t, 3 * t + 1, 3 * t + 2};
    const Bytes reel = reel_of(split);
    EXPECT_LE(farthest(*decode(reel), played(*Player::open(reel))), promised);
}

TEST(Player, TakesABaseMeshForItsOrderAndFailsWithoutIt)
{
    const Animation animation = wave();
    EncodeOptions options;
    options.order = Order::base;
    options.base = &animation;
    const Bytes reel = reel_of(animation, options);
    EXPECT_EQ(Player::open(reel).error().code, ErrorCode::usage);
    EXPECT_LE(farthest(*decode(reel, {.base = &animation}), played(*Player::open(reel, {.base = &animation}))),
              promised);
}

TEST(Player, PosesAFrameToTheSameBitsAloneAmongOthersAndByItsTime)
{
    const Bytes reel = reel_of(wave(), cut_into(16));
    Player player = *Player::open(reel);
    const std::vector<float> all = played(player);
    EXPECT_EQ(played_at(player, decode(reel)->times_s), all);
    std::vector<float> frame(3ul * player.vertex_count());
    player.seek_frame(23);
    player.pose(frame);
    EXPECT_TRUE(std::equal(frame.begin(), frame.end(), all.begin() + 23 * static_cast<std::ptrdiff_t>(frame.size())));
}

TEST(Player, StaysAtTheFirstAndTheLastFrameOutsideTheAnimation)
{
    Player player = *Player::open(reel_of(wave()));
    const double end = player.times_s().back();
    EXPECT_EQ(played_at(player, {-5.0}), played_at(player, {player.times_s()[0]}));
    EXPECT_EQ(played_at(player, {end + 1e9, HUGE_VAL, std::nan("")}), played_at(player, {end, end, end}));
}

TEST(Player, GoesOnWithALoop)
{
    Animation loop = wave();
    loop.meta.loop = true;
    loop.meta.fps = 25;
    const Bytes reel = reel_of(loop, cut_into(12));
    Player player = *Player::open(reel);
    const Animation exact = *decode(reel, {.fps = 67});
    std::vector<double> later = exact.times_s;
    for (double& t : later) t += 7 * 40 / 25.0;
    EXPECT_LE(farthest(exact, played_at(player, later)), promised);
    EXPECT_LE(farthest(exact, played_at(player, exact.times_s)), promised);
    EXPECT_EQ(played_at(player, {-0.3}), played_at(player, {exact.times_s[0]}));
}

TEST(Player, PosesTheSameBitsHoweverManyThreadsOpenedIt)
{
    const Bytes reel = reel_of(wave());
    EXPECT_EQ(played(*Player::open(reel, {.threads = {1}})), played(*Player::open(reel, {.threads = {3}})));
}

TEST(Player, CanBeMovedInTheMiddleOfPlaying)
{
    Player player = *Player::open(reel_of(wave(), cut_into(12)));
    const std::vector<float> before = played_at(player, {0.47});
    Player moved = std::move(player);
    std::vector<float> after(before.size());
    moved.pose(after);
    EXPECT_EQ(before, after);
}

TEST(Player, RefusesEveryTruncatedFile)
{
    const Bytes reel = reel_of(test_shapes::torus());
    for (std::size_t size = 0; size < reel.size(); ++size)
        EXPECT_FALSE(Player::open(ByteView(reel).first(size)).ok()) << size;
}

TEST(Player, RefusesPositionsThatFloat32CannotSum)
{
    Animation huge = wave();
    for (float& x : huge.positions) x *= 1e37f;
    const Bytes reel = reel_of(huge, with_bases(5));
    const auto refused = Player::open(reel);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().field, "SEGM");
}

TEST(Player, RefusesWhatDoesNotFitTheMemoryLimit)
{
    const Bytes reel = reel_of(shape("wave", {.vertices = 2000, .frames = 10}), with_bases(20));
    const auto refused = Player::open(reel, {.limits = {.max_memory = 100'000}});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
}
