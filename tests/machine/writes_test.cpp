/// A disk that fails at any call: what was there before is there again, no descriptor stays open, and the error says why.
// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstdio>

#include "meshreel/io/io.h"
#include "meshreel/meshreel.h"
#include "tests/machine/calls.h"
#include "tests/machine/folder.h"

using namespace meshreel;
using namespace meshreel::machine;

namespace {

class Disk : public FolderTest, public testing::WithParamInterface<const char*> {
protected:
    /// As the command does it: .reel files by their bytes, "frames.*" frame by frame.
    Status save() const
    {
        const std::string name = GetParam();
        const bool still = name == "a.obj" || name == "a.ply" || name == "a.off";
        const Animation animation = small_animation(still ? 1 : 3);
        if (name == "a.reel") return write_file(path(name), encode(animation)->bytes, true);
        io::SaveOptions options;
        options.overwrite = true;
        if (!name.starts_with("frames.")) return io::save(animation, path(name), options);
        HeldFrames frames(animation);
        return (*io::format_of(name))->save_frames(frames, path(name), options);
    }

    /// One fault after the other, over what `before` says.
    std::size_t fail_at_every_call(const std::map<std::string, Bytes>& before)
    {
        std::size_t tried = 0;
        for (const Call call : calls)
            for (const How how : {How::refused, How::short_first}) {
                if (how == How::short_first && call != Call::write) continue;
                for (std::size_t number = 0; number < count_of(call); ++number) {
                    fail_at(call, number, how, before);
                    ++tried;
                }
            }
        return tried;
    }

private:
    std::size_t count_of(Call call) const
    {
        const std::map<std::string, Bytes> there = contents();
        std::size_t all = 0;
        {
            const Count count;
            EXPECT_TRUE(save().ok());
            all = count.of(call);
        }
        restore(there);
        return all;
    }

    void restore(const std::map<std::string, Bytes>& there) const
    {
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) std::filesystem::remove(entry.path());
        for (const auto& [name, bytes] : there) EXPECT_TRUE(write_file(path(name), bytes, true).ok());
    }

    void fail_at(Call call, std::size_t number, How how, const std::map<std::string, Bytes>& before) const
    {
        SCOPED_TRACE(std::string(call_names[static_cast<std::size_t>(call)]) + " " + std::to_string(number));
        const std::size_t open_before = open_files();
        bool happened = false;
        Status saved = Ok{};
        {
            const Fault fault(call, number, how == How::short_first ? ENOSPC : EIO, how);
            saved = save();
            happened = fault.happened();
        }
        EXPECT_TRUE(happened);
        EXPECT_EQ(open_files(), open_before);
        if (saved.ok()) { // only a file that was read was closed, or the last name taken was not needed any more
            EXPECT_EQ(call, Call::close);
            return restore(before);
        }
        EXPECT_EQ(saved.error().code, ErrorCode::io);
        EXPECT_NE(saved.error().message.find(how == How::short_first ? "No space left" : "Input/output"),
                  std::string::npos)
            << saved.error().sentence();
        EXPECT_FALSE(saved.error().file.empty());
        EXPECT_EQ(contents(), before);
    }
};

INSTANTIATE_TEST_SUITE_P(Format, Disk,
                         testing::Values("a.obj", "a.###.obj", "a.ply", "a.###.ply", "a.off", "a.pc2", "a.mdd", "a.glb",
                                         "a.gltf", "frames.pc2", "frames.mdd", "a.reel"),
                         [](const auto& row) {
                             std::string name = row.param;
                             for (char& c : name)
                                 if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                             return name;
                         });

} // namespace

TEST_P(Disk, ThatFailsAtAnyCallLeavesNothing)
{
    std::printf("%s: %zu failing calls tried\n", GetParam(), fail_at_every_call({}));
}

TEST_P(Disk, ThatFailsAtAnyCallLeavesTheOldOutput)
{
    ASSERT_TRUE(save().ok());
    std::map<std::string, Bytes> before = contents();
    for (auto& [name, bytes] : before) bytes.push_back('\n'); // not what is written again
    for (const auto& [name, bytes] : before) ASSERT_TRUE(write_file(path(name), bytes, true).ok());
    std::printf("%s: %zu failing calls tried\n", GetParam(), fail_at_every_call(before));
}

TEST_P(Disk, ThatTakesAFewBytesAtATimeOrIsInterruptedGetsThemAll)
{
    ASSERT_TRUE(save().ok());
    const std::map<std::string, Bytes> whole = contents();
    {
        const Fault fault(Call::write, 0, 0, How::in_pieces);
        ASSERT_TRUE(save().ok());
    }
    EXPECT_EQ(contents(), whole);
    for (std::size_t number = 0; number < 3; ++number) {
        const Fault fault(Call::write, number, EINTR, How::interrupted);
        ASSERT_TRUE(save().ok());
    }
    EXPECT_EQ(contents(), whole);
}
