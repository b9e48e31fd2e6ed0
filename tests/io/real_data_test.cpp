/// The real sequences beside the project, where they are: counts, and no warning that is not expected.
// SPDX-License-Identifier: MIT
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

const std::string data = std::string(MESHREEL_SOURCE_DIR) + "/../shared/data/";

struct RealCounts {
    const char* name;
    std::uint32_t vertices;
    std::size_t triangles, frames;
};

} // namespace

class RealSequence : public testing::TestWithParam<RealCounts> {};

TEST_P(RealSequence, IsReadWithItsCounts)
{
    const RealCounts expected = GetParam();
    if (!std::filesystem::exists(data + expected.name)) GTEST_SKIP() << "no data beside the project";
    LoadOptions options;
    options.fps = 25;
    options.mesh = data + expected.name + "/mesh.obj";
    options.warn = [](const std::string& sentence) { ADD_FAILURE() << sentence; };
    const auto read = load(data + expected.name + "/motion.pc2", options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->vertex_count, expected.vertices);
    EXPECT_EQ(read->triangles.size(), expected.triangles);
    EXPECT_EQ(read->frame_count(), expected.frames);
    EXPECT_EQ(read->times_s.back(), static_cast<double>(expected.frames - 1) / 25);
}

TEST_P(RealSequence, WritesBackToTheSameBytes)
{
    const std::string path = data + GetParam().name + "/motion.pc2";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no data beside the project";
    const Folder folder;
    LoadOptions options;
    options.fps = 30;
    options.mesh = data + GetParam().name + "/mesh.obj";
    ASSERT_TRUE(save(*load(path, options), folder / "back.pc2").ok());
    EXPECT_EQ(read(folder / "back.pc2"), read(path));
}

INSTANTIATE_TEST_SUITE_P(Data, RealSequence,
                         testing::Values(RealCounts{"chicken", 3030, 5664, 400}, RealCounts{"dance", 7061, 14118, 201},
                                         RealCounts{"cow", 2904, 5804, 204}, RealCounts{"crane", 10002, 20000, 175},
                                         RealCounts{"horse_gallop", 8431, 16843, 48},
                                         RealCounts{"walker", 13380, 26756, 120},
                                         RealCounts{"cloth", 10000, 19602, 200}, RealCounts{"flag", 6144, 11970, 150},
                                         RealCounts{"snake", 9179, 18354, 134}, RealCounts{"dolphin", 4012, 8000, 101},
                                         RealCounts{"bone", 754, 1504, 400}),
                         [](const auto& made) { return made.param.name; });

TEST(RealFile, TheQuakeModelsAreReadWithTheirCounts)
{
    if (!std::filesystem::exists(data + "files/sydney.md2")) GTEST_SKIP() << "no data beside the project";
    const auto md2 = load(data + "files/sydney.md2");
    ASSERT_TRUE(md2.ok()) << why(md2);
    EXPECT_EQ(md2->vertex_count, 342u);
    EXPECT_EQ(md2->triangles.size(), 679u);
    EXPECT_EQ(md2->frame_count(), 198u);
    LoadOptions options;
    options.clip = "taunt";
    EXPECT_EQ(load(data + "files/sydney.md2", options)->frame_count(), 17u);
    const auto md3 = load(data + "files/sarge_upper.md3");
    ASSERT_TRUE(md3.ok()) << why(md3);
    EXPECT_EQ(md3->frame_count(), 155u);
    EXPECT_GT(md3->vertex_count, 300u);
}
