/// Files appear whole or not at all.
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

#include "meshreel/base/file.h"

using namespace meshreel;
namespace fs = std::filesystem;

namespace {

/// An empty folder of this test's own.
class FileTest : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::size_t files() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

} // namespace

TEST_F(FileTest, WhatIsWrittenIsReadBack)
{
    const Bytes bytes{1, 2, 3, 0, 255};
    ASSERT_TRUE(write_file(path("a"), bytes, false).ok());
    EXPECT_EQ(*read_file(path("a")), bytes);
    EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, AnExistingFileIsOverwrittenOnlyWhenAllowed)
{
    ASSERT_TRUE(write_file(path("a"), Bytes{1}, false).ok());
    EXPECT_EQ(write_file(path("a"), Bytes{2}, false).error().code, ErrorCode::usage);
    EXPECT_EQ(*read_file(path("a")), Bytes{1});
    EXPECT_TRUE(write_file(path("a"), Bytes{2}, true).ok());
    EXPECT_EQ(*read_file(path("a")), Bytes{2});
}

TEST_F(FileTest, AFileThatIsNotCommittedLeavesNothing)
{
    {
        auto file = AtomicFile::create(path("a"), false);
        ASSERT_TRUE(file.ok());
        ASSERT_TRUE(file->write(Bytes(1000)).ok());
        EXPECT_FALSE(fs::exists(path("a")));
    }
    EXPECT_EQ(files(), 0u);
}

TEST_F(FileTest, WhatIsNotCommittedYetIsReadBackWhereItIsAsked)
{
    auto file = AtomicFile::create(path("a"), false);
    ASSERT_TRUE(file.ok() && file->reads_back());
    ASSERT_TRUE(file->write(Bytes{1, 2, 3}).ok() && file->write(Bytes{4}).ok());
    EXPECT_EQ(file->size(), 4u);
    EXPECT_EQ(*file->fetch(1, 3), (Bytes{2, 3, 4}));
    EXPECT_EQ(file->fetch(2, 3).error().code, ErrorCode::io);
    EXPECT_FALSE(AtomicFile::create("/dev/null", false)->reads_back());
}

TEST_F(FileTest, ADeviceIsWrittenStraightAndNeverReplaced)
{
    ASSERT_TRUE(write_file("/dev/null", Bytes(10), false).ok());
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_EQ(write_file("/dev/full", Bytes(10), false).error().code, ErrorCode::io);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(FileTest, WhatHadANameIsBroughtBack)
{
    ASSERT_TRUE(write_file(path("a"), Bytes{1}, false).ok());
    {
        auto old = Former::keep(path("a")), nothing = Former::keep(path("b"));
        ASSERT_TRUE(old.ok() && nothing.ok());
        ASSERT_TRUE(write_file(path("a"), Bytes{2}, true).ok() && write_file(path("b"), Bytes{2}, false).ok());
        Former moved = std::move(*old);
        moved.bring_back();
        nothing->bring_back();
    }
    EXPECT_EQ(*read_file(path("a")), Bytes{1});
    EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, WhatHadANameIsLetGo)
{
    ASSERT_TRUE(write_file(path("a"), Bytes{1}, false).ok());
    {
        const auto old = Former::keep(path("a"));
        ASSERT_TRUE(old.ok() && write_file(path("a"), Bytes{2}, true).ok());
    }
    EXPECT_EQ(*read_file(path("a")), Bytes{2});
    EXPECT_EQ(files(), 1u);
    Former::keep("/dev/null")->bring_back();
    Former::keep("-")->bring_back();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, AFolderIsNeitherReadNorWritten)
{
    EXPECT_EQ(read_file(folder_.string()).error().code, ErrorCode::io);
    EXPECT_EQ(write_file(folder_.string(), Bytes(10), true).error().code, ErrorCode::io);
}

TEST_F(FileTest, AFileAboveTheMemoryLimitIsRefused)
{
    ASSERT_TRUE(write_file(path("a"), Bytes(5000), false).ok());
    DecodeLimits limits;
    limits.max_memory = 4999;
    EXPECT_EQ(read_file(path("a"), limits).error().code, ErrorCode::bad_input);
    limits.max_memory = 5000;
    EXPECT_TRUE(read_file(path("a"), limits).ok());
}
