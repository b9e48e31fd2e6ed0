/// Sequences: names, order, gaps, ranges, times, and frames that do not belong together.
// SPDX-License-Identifier: MIT
#include <csignal>
#include <sys/resource.h>

#include "meshreel/io/pattern.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

std::string triangle_at(int x, const std::string& face = "f 1 2 3\n")
{
    return "v " + std::to_string(x) + " 0 0\nv 1 0 0\nv 1 1 0\n" + face;
}

/// The first coordinate of each frame: which file it came from.
std::vector<float> order(const Animation& animation)
{
    std::vector<float> firsts;
    for (std::size_t f = 0; f < animation.frame_count(); ++f) firsts.push_back(animation.frame(f)[0]);
    return firsts;
}

std::string pattern_path(const std::string& pattern, std::uint64_t number)
{
    return (*parse_pattern(pattern))->path(number);
}

} // namespace

TEST(Pattern, NumbersAreFilledUpWithZeros)
{
    EXPECT_EQ(pattern_path("a/walk.####.obj", 7), "a/walk.0007.obj");
    EXPECT_EQ(pattern_path("walk%03d.obj", 1234), "walk1234.obj");
    EXPECT_EQ(pattern_path("walk.%d.obj", 12), "walk.12.obj");
    EXPECT_FALSE(parse_pattern("a#b/walk.obj")->has_value());
    EXPECT_EQ(parse_pattern("walk##x##.obj").error().code, ErrorCode::usage);
}

TEST(Pattern, NaturalOrderComparesDigitsAsNumbers)
{
    EXPECT_TRUE(natural_less("walk2", "walk10"));
    EXPECT_FALSE(natural_less("walk10", "walk2"));
    EXPECT_TRUE(natural_less("a1b2", "a1b10"));
    EXPECT_TRUE(natural_less("a", "a1"));
    EXPECT_NE(natural_less("a07", "a7"), natural_less("a7", "a07"));
    EXPECT_FALSE(natural_less("a7", "a7"));
}

TEST(Pattern, GlobsMatchWholeNames)
{
    EXPECT_TRUE(glob_matches("walk.*.obj", "walk.1.obj"));
    EXPECT_TRUE(glob_matches("*a*b?", "xxaybaabz"));
    EXPECT_FALSE(glob_matches("walk.*.obj", "walk.1.obj.tmp"));
    EXPECT_FALSE(glob_matches("?", ""));
}

TEST(Sequence, FilesAreFoundByHashesPercentAndGlobInNaturalOrder)
{
    const Folder folder;
    for (int i = 8; i < 12; ++i) {
        write(folder / ("a." + std::to_string(i) + ".obj"), triangle_at(i));
        const std::string two = (i < 10 ? "0" : "") + std::to_string(i);
        write(folder / ("b" + two + ".obj"), triangle_at(i));
    }
    write(folder / "b009.obj", triangle_at(99));
    for (const char* name : {"a.#.obj", "a.%d.obj", "a.*.obj", "b##.obj", "b%02d.obj", "b??.obj"}) {
        const auto read = load(folder / name);
        ASSERT_TRUE(read.ok()) << why(read);
        EXPECT_EQ(order(*read), (std::vector<float>{8, 9, 10, 11})) << name;
    }
}

TEST(Sequence, AGapInTheNumbersIsTold)
{
    const Folder folder;
    for (int i : {1, 2, 5, 7}) write(folder / ("a" + std::to_string(i) + ".obj"), triangle_at(i));
    Listener listener;
    ASSERT_TRUE(load(folder / "a#.obj", listener.options).ok());
    EXPECT_TRUE(listener.has("numbers 3 to 4 are missing"));
    EXPECT_TRUE(listener.has("number 6 is missing"));
}

TEST(Sequence, TimesAreThePlacesInTheSourceOverFps)
{
    const Folder folder;
    for (int i = 0; i < 6; ++i) write(folder / ("a" + std::to_string(i) + ".obj"), triangle_at(i));
    Listener listener;
    listener.options.frames = {1, 4, 2};
    const auto unknown = load(folder / "a#.obj", listener.options);
    EXPECT_EQ(unknown->times_s, (std::vector<double>{1 / 24.0, 3 / 24.0}));
    EXPECT_EQ(unknown->meta.fps, 0.0);
    EXPECT_TRUE(listener.has("24 frames a second are taken"));
    listener.options.fps = 50;
    const auto known = load(folder / "a#.obj", listener.options);
    EXPECT_EQ(order(*known), (std::vector<float>{1, 3}));
    EXPECT_EQ(known->times_s, (std::vector<double>{1 / 50.0, 3 / 50.0}));
    EXPECT_EQ(known->meta.fps, 25.0);
}

TEST(Sequence, AFrameOfAnotherMeshIsRefusedWithItsFileAndReason)
{
    const Folder folder;
    write(folder / "a1.obj", triangle_at(1));
    write(folder / "a2.obj", triangle_at(2, "f 1 3 2\n"));
    EXPECT_EQ(why(load(folder / "a#.obj")),
              (folder / "a2.obj") + ": triangles: frame 1: triangle 0 is (0 2 1), in the first frame (" +
                  (folder / "a1.obj") + ") it is (0 1 2); the connectivity must not change");
    write(folder / "a2.obj", "v 1 1 1\n" + triangle_at(2));
    EXPECT_NE(why(load(folder / "a#.obj")).find("frame 1 has 4 vertices, the first frame"), std::string::npos);
    write(folder / "a2.obj", triangle_at(2, ""));
    EXPECT_NE(why(load(folder / "a#.obj")).find("frame 1 has 0 triangles"), std::string::npos);
    write(folder / "a2.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    EXPECT_EQ(why(load(folder / "a#.obj")), (folder / "a2.obj") + ": positions: frame 1, vertex 0, x is not a number");
    write(folder / "a2.obj", "v 1 0\n");
    EXPECT_TRUE(why(load(folder / "a#.obj")).starts_with((folder / "a2.obj") + ": line 1: v: 2 numbers"));
}

TEST(Sequence, AttributesThatChangeAreToldOnce)
{
    const Folder folder;
    for (int i = 0; i < 4; ++i)
        write(folder / ("a" + std::to_string(i) + ".obj"),
              triangle_at(i, "vt " + std::to_string(i) + " 0\nf 1/1 2/1 3/1\n"));
    Listener listener;
    listener.options.fps = 1;
    ASSERT_TRUE(load(folder / "a#.obj", listener.options).ok());
    ASSERT_EQ(listener.heard.size(), 1u);
    EXPECT_EQ(listener.heard[0],
              (folder / "a1.obj") + ": the attribute uv0 differs from the first frame's, which is kept");
}

TEST(Sequence, MissingFilesAndEmptyRangesAreNamed)
{
    const Folder folder;
    EXPECT_EQ(load(folder / "a#.obj").error().code, ErrorCode::io);
    EXPECT_EQ(load(folder / "a.obj").error().code, ErrorCode::io);
    EXPECT_EQ(load(folder / "nowhere/a#.obj").error().code, ErrorCode::io);
    EXPECT_EQ(load(folder / "a.xyz").error().code, ErrorCode::unsupported);
    write(folder / "a1.obj", triangle_at(1));
    write(folder / "a01.obj", triangle_at(1));
    EXPECT_NE(why(load(folder / "a#.obj")).find("are both number 1"), std::string::npos);
    LoadOptions options;
    options.frames.first = 1;
    EXPECT_EQ(load(folder / "a1.obj", options).error().code, ErrorCode::usage);
    options.frames = {0, 0, 0};
    EXPECT_EQ(load(folder / "a1.obj", options).error().code, ErrorCode::usage);
}

class EveryFormat : public testing::TestWithParam<const char*> {};

TEST_P(EveryFormat, WritesASequenceThatReadsBackToTheSameBits)
{
    const Folder folder;
    Animation made = tetrahedron(13);
    made.meta.fps = 24;
    const std::string extension = GetParam(), path = folder / ("out.##." + extension);
    const auto saved = save(made, path);
    ASSERT_TRUE(saved.ok()) << why(saved);
    EXPECT_EQ(folder.file_count(), 13u);
    EXPECT_TRUE(std::filesystem::exists(folder / ("out.00." + extension)));
    LoadOptions options;
    options.fps = 24;
    const auto read = load(path, options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_TRUE(same_bits(read->positions, made.positions));
    EXPECT_EQ(read->triangles, made.triangles);
    EXPECT_EQ(read->times_s, made.times_s);
}

TEST_P(EveryFormat, NeedsAPatternForSeveralFrames)
{
    const Folder folder;
    const std::string extension = GetParam();
    EXPECT_EQ(save(tetrahedron(2), folder / ("out." + extension)).error().code, ErrorCode::usage);
    EXPECT_EQ(save(tetrahedron(2), folder / ("out.*." + extension)).error().code, ErrorCode::usage);
    EXPECT_TRUE(save(tetrahedron(1), folder / ("out." + extension)).ok());
    EXPECT_EQ(save(tetrahedron(1), folder / ("out." + extension)).error().code, ErrorCode::usage); // exists
}

TEST_P(EveryFormat, LeavesNothingBehindWhereItFails)
{
    const Folder folder;
    const std::string extension = GetParam(), path = folder / ("out.#." + extension);
    write(folder / ("out.7." + extension), "precious");
    EXPECT_FALSE(save(tetrahedron(9), path).ok());
    EXPECT_EQ(folder.file_count(), 1u);
    EXPECT_EQ(read(folder / ("out.7." + extension)), "precious");
    std::filesystem::remove(folder / ("out.7." + extension));
    std::filesystem::create_directories(folder / ("out.7." + extension + "/full"));
    SaveOptions options;
    options.overwrite = true;
    EXPECT_EQ(save(tetrahedron(9), path, options).error().code, ErrorCode::io); // a folder is in the way of a rename
    EXPECT_EQ(folder.file_count(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Meshes, EveryFormat, testing::Values("obj", "ply", "off"));

TEST(Sequence, MoreFramesThanOpenFilesAreWritten)
{
    const Folder folder;
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit few{64, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
    const auto saved = save(tetrahedron(200), folder / "a###.obj");
    setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_TRUE(saved.ok()) << why(saved);
    EXPECT_EQ(folder.file_count(), 200u);
}

TEST(Sequence, AFullDiskLeavesNothingBehind)
{
    const Folder folder;
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto saved = save(tetrahedron(3), folder / "a#.obj");
    const auto cache = save(tetrahedron(3), folder / "a.pc2");
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(saved.error().code, ErrorCode::io);
    EXPECT_EQ(cache.error().code, ErrorCode::io);
    EXPECT_EQ(folder.file_count(), 0u);
}
