/// PC2 and MDD: times, mesh, bytes.
// SPDX-License-Identifier: MIT
#include "meshreel/io/point_cache.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

TEST(PointCache, Pc2AndMddGiveBackPositionsBitForBitAndTimes)
{
    const Animation made = tetrahedron(5);
    LoadOptions options;
    const auto pc2 = parse_pc2(*write_pc2(made), tetrahedron(1), options);
    const auto mdd = parse_mdd(*write_mdd(made), tetrahedron(1), options);
    ASSERT_TRUE(pc2.ok()) << why(pc2);
    ASSERT_TRUE(mdd.ok()) << why(mdd);
    EXPECT_TRUE(same_bits(pc2->positions, made.positions));
    EXPECT_TRUE(same_bits(mdd->positions, made.positions));
    for (std::size_t f = 0; f < 5; ++f) {
        EXPECT_NEAR(pc2->times_s[f], made.times_s[f], 1e-12);
        EXPECT_EQ(mdd->times_s[f], static_cast<float>(made.times_s[f]));
    }
}

TEST(PointCache, Pc2CountsTimeInFramesOfItsScene)
{
    Animation made = tetrahedron(3);
    made.times_s = {1.0, 1.5, 2.0};
    made.meta.fps = 30.0;
    LoadOptions options;
    options.fps = 60.0;
    const auto read = parse_pc2(*write_pc2(made), tetrahedron(1), options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->times_s, (std::vector<double>{0.5, 0.75, 1.0}));
    EXPECT_EQ(read->meta.fps, 4.0);
}

TEST(PointCache, FpsReplacesTheTimesOfAnMdd)
{
    LoadOptions options;
    options.fps = 10.0;
    const auto read = parse_mdd(*write_mdd(tetrahedron(3)), tetrahedron(1), options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->times_s, (std::vector<double>{0.0, 0.1, 0.2}));
    EXPECT_EQ(read->meta.fps, 10.0);
}

TEST(PointCache, ARangeOfFramesKeepsItsTimes)
{
    LoadOptions options;
    options.fps = 24.0;
    options.frames = {1, 5, 2};
    const Animation made = tetrahedron(7);
    const auto read = parse_pc2(*write_pc2(made), tetrahedron(1), options);
    ASSERT_TRUE(read.ok()) << why(read);
    ASSERT_EQ(read->frame_count(), 3u);
    EXPECT_EQ(read->times_s[2], 5 / 24.0);
    EXPECT_EQ(read->meta.fps, 12.0);
    EXPECT_TRUE(std::equal(read->frame(2).begin(), read->frame(2).end(), made.frame(5).begin()));
}

TEST(PointCache, UnevenTimesGoIntoAnMddOnly)
{
    Animation made = tetrahedron(3);
    made.times_s = {0.0, 0.1, 0.5};
    EXPECT_EQ(write_pc2(made).error().code, ErrorCode::unsupported);
    EXPECT_TRUE(write_mdd(made).ok());
    made.times_s = {0.0, 1.0, 1.0 + 1e-12};
    EXPECT_EQ(write_mdd(made).error().code, ErrorCode::unsupported);
}

TEST(PointCache, EveryTruncationIsAnError)
{
    const Bytes pc2 = *write_pc2(tetrahedron(2)), mdd = *write_mdd(tetrahedron(2));
    for (std::size_t size = 0; size < pc2.size(); ++size)
        EXPECT_FALSE(parse_pc2(ByteView(pc2).first(size), tetrahedron(1), {}).ok()) << size;
    for (std::size_t size = 0; size < mdd.size(); ++size)
        EXPECT_FALSE(parse_mdd(ByteView(mdd).first(size), tetrahedron(1), {}).ok()) << size;
}

TEST(PointCache, EveryFlippedBitGivesAnErrorOrAValidAnimation)
{
    const Bytes good = *write_pc2(tetrahedron(2)), good_mdd = *write_mdd(tetrahedron(2));
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        Bytes bad = good, bad_mdd = good_mdd;
        bad[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        bad_mdd[bit / 8 % bad_mdd.size()] ^= static_cast<std::uint8_t>(1u << bit % 8);
        const auto pc2 = parse_pc2(bad, tetrahedron(1), {});
        EXPECT_TRUE(!pc2.ok() || !validate(*pc2).ok() || pc2->frame_count() <= 2) << bit;
        const auto mdd = parse_mdd(bad_mdd, tetrahedron(1), {});
        EXPECT_TRUE(!mdd.ok() || validate(*mdd).ok()) << bit;
    }
}

TEST(PointCache, ErrorsNameTheField)
{
    Bytes bytes = *write_pc2(tetrahedron(2));
    Animation other = tetrahedron(1);
    other.vertex_count = 3;
    EXPECT_EQ(why(parse_pc2(bytes, other, {})), "byte 16: vertex_count: the cache has 4 vertices, the mesh has 3");
    bytes[31] = 0x7f;
    EXPECT_NE(why(parse_pc2(bytes, tetrahedron(1), {})).find("above the limit"), std::string::npos);
    bytes[31] = 0xff;
    EXPECT_EQ(why(parse_pc2(bytes, tetrahedron(1), {})), "byte 28: frame_count: -16777214 frames");
    EXPECT_EQ(why(parse_pc2(bytes_of("v 0 0 0\nv 1 1 1\n"), tetrahedron(1), {})),
              "byte 0: signature: this is no PC2 file: it does not begin with POINTCACHE2");
}

TEST(PointCache, NanAndInfinityAreRefusedByFrameAndVertex)
{
    Animation made = tetrahedron(2);
    made.positions[12 + 3 * 2 + 1] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(why(parse_pc2(*write_pc2(made), tetrahedron(1), {})), "positions: frame 1, vertex 2, y is infinite");
    made.positions[12 + 3 * 2 + 1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(why(parse_mdd(*write_mdd(made), tetrahedron(1), {})), "positions: frame 1, vertex 2, y is not a number");
}

TEST(PointCache, ACacheWithoutItsMeshIsAUsageError)
{
    const Folder folder;
    ASSERT_TRUE(save(tetrahedron(2), folder / "a.pc2").ok());
    EXPECT_EQ(load(folder / "a.pc2").error().code, ErrorCode::usage);
    ASSERT_TRUE(save(tetrahedron(1), folder / "a.obj").ok());
    LoadOptions options;
    options.mesh = folder / "a.obj";
    const auto read = load(folder / "a.pc2", options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->triangles, tetrahedron(1).triangles);
}
