/// A test with a folder of its own, and what is in it.
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "meshreel/base/file.h"
#include "meshreel/mesh/test_shapes.h"

namespace meshreel::machine {

/// A mesh that moves a little.
inline Animation small_animation(std::size_t frame_count)
{
    Animation a = test_shapes::two_components();
    const std::size_t width = 3ul * a.vertex_count;
    a.positions.resize(width);
    for (std::size_t f = 1; f < frame_count; ++f)
        for (std::size_t i = 0; i < width; ++i)
            a.positions.push_back(a.positions[i] + 0.01f * static_cast<float>(f * (i % 5)));
    a.times_s = uniform_times(frame_count, 25.0);
    return a;
}

class FolderTest : public testing::Test {
protected:
    void SetUp() override
    {
        std::string pattern = (std::filesystem::path(testing::TempDir()) / "meshreel-machine-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// Names and bytes of all files.
    std::map<std::string, Bytes> contents() const
    {
        std::map<std::string, Bytes> all;
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            all[entry.path().filename()] = *read_file(entry.path());
        return all;
    }

    std::filesystem::path folder_;
};

/// Open files of this process.
inline std::size_t open_files()
{
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(all, std::filesystem::directory_iterator()));
}

} // namespace meshreel::machine
