/// Frames that are read when they are asked for are those that load() gives; files that change meanwhile are noticed.
// SPDX-License-Identifier: MIT
#include "meshreel/io/point_cache.h"
#include "meshreel/io/sequence.h"
#include "meshreel/io/streamed_frames.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

void expect_same_frames(FrameSource& source, const Animation& loaded)
{
    Matrix<float> room;
    EXPECT_EQ(source.still().times_s, loaded.times_s);
    EXPECT_EQ(source.still().triangles, loaded.triangles);
    for (const std::size_t f : {4u, 0u, 2u, 0u}) {
        const auto frames = source.frames(f, 1, room);
        ASSERT_TRUE(frames.ok()) << why(frames);
        EXPECT_TRUE(std::equal(loaded.frame(f).begin(), loaded.frame(f).end(), frames->data));
    }
}

/// A tetrahedron of nine frames as FOLDER/t.EXTENSION, and the options to open it with.
LoadOptions saved(const Folder& folder, const std::string& extension)
{
    LoadOptions options;
    options.mesh = folder / "mesh.obj";
    options.frames = {1, 8, 1};
    EXPECT_TRUE(save(tetrahedron(1), options.mesh).ok());
    EXPECT_TRUE(save(tetrahedron(9), folder / ("t." + extension)).ok());
    return options;
}

} // namespace

TEST(StreamedFrames, OfPointCachesAreThoseThatLoadGives)
{
    for (const std::string extension : {"pc2", "mdd"}) {
        const Folder folder;
        const LoadOptions options = saved(folder, extension);
        const auto source = io::open(folder / ("t." + extension), options);
        ASSERT_TRUE(source.ok()) << why(source);
        EXPECT_TRUE((*source)->still().positions.empty()) << "they stay in the file";
        expect_same_frames(**source, *load(folder / ("t." + extension), options));
    }
}

TEST(StreamedFrames, OfSequencesAreThoseThatLoadGives)
{
    const Folder folder;
    ASSERT_TRUE(save(tetrahedron(5), folder / "t.##.obj").ok());
    const auto source = io::open(folder / "t.##.obj");
    ASSERT_TRUE(source.ok()) << why(source);
    expect_same_frames(**source, *load(folder / "t.##.obj"));
}

TEST(StreamedFrames, AreWrittenAsTheAnimationIs)
{
    const Folder folder;
    const Animation made = tetrahedron(7);
    HeldFrames frames(made);
    ASSERT_TRUE(save_pc2_frames(frames, folder / "a.pc2", {}).ok());
    ASSERT_TRUE(save_mdd_frames(frames, folder / "a.mdd", {}).ok());
    EXPECT_EQ(bytes_of(read(folder / "a.pc2")), *write_pc2(made));
    EXPECT_EQ(bytes_of(read(folder / "a.mdd")), *write_mdd(made));
}

TEST(StreamedFrames, ChangedFilesAreNoticedByFrame)
{
    const Folder folder;
    const auto source = io::open(folder / "t.pc2", saved(folder, "pc2"));
    Matrix<float> room;
    ASSERT_TRUE((*source)->frames(0, 8, room).ok());
    std::string bytes = read(folder / "t.pc2");
    bytes[32 + 3 * 48 + 5] ^= 1;
    write(folder / "t.pc2", bytes);
    const auto changed = (*source)->frames(0, 8, room);
    ASSERT_FALSE(changed.ok());
    EXPECT_EQ(why(changed), folder / "t.pc2: frame 3 is not what it was when it was read first");
}

TEST(StreamedFrames, AFileThatShrinksIsAnError)
{
    const Folder folder;
    const auto source = io::open(folder / "t.mdd", saved(folder, "mdd"));
    Matrix<float> room;
    ASSERT_TRUE((*source)->frames(0, 8, room).ok());
    write(folder / "t.mdd", read(folder / "t.mdd").substr(0, 200));
    const auto shrunk = (*source)->frames(0, 8, room);
    ASSERT_FALSE(shrunk.ok());
    EXPECT_EQ(shrunk.error().code, ErrorCode::io);
}

TEST(StreamedFrames, AHeaderThatPromisesTooMuchIsRefusedBeforeAnyFrame)
{
    const Folder folder;
    const LoadOptions options = saved(folder, "pc2");
    write(folder / "t.pc2", read(folder / "t.pc2").substr(0, 300));
    EXPECT_EQ(io::open(folder / "t.pc2", options).error().field, "positions");
}
