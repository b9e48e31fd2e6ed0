/// Files that become shorter while they are read, or are gone: an error, never a signal.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "meshreel/codecs/codec.h"
#include "meshreel/meshreel.h"
#include "tests/machine/folder.h"

using namespace meshreel;
using namespace meshreel::machine;

namespace {

/// A file that is cut before one of the fetches.
class ShrinkingFile : public ByteSource {
public:
    ShrinkingFile(FileSource file, std::string path, std::size_t fetch, std::uint64_t left)
        : file_(std::move(file)), path_(std::move(path)), fetch_(fetch), left_(left)
    {
    }
    std::uint64_t size() const override { return file_.size(); }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override
    {
        if (fetches_++ == fetch_) std::filesystem::resize_file(path_, left_);
        return file_.fetch(offset, count);
    }
    std::size_t fetches() const { return fetches_; }

private:
    FileSource file_;
    std::string path_;
    std::size_t fetch_, fetches_ = 0;
    std::uint64_t left_;
};

class Shrinking : public FolderTest {
protected:
    /// Decodes while the file is cut. @return false: there is no such fetch.
    bool decode_while_cut(const Bytes& reel, std::size_t fetch, std::uint64_t left)
    {
        EXPECT_TRUE(write_file(path("a.reel"), reel, true).ok());
        ShrinkingFile file(*FileSource::open(path("a.reel")), path("a.reel"), fetch, left);
        const auto frames = open_frames(file);
        Matrix<float> room;
        Status status = frames.ok() ? Status(Ok{}) : Status(frames.error());
        for (std::size_t f = 0; frames.ok() && status.ok() && f < (*frames)->still().frame_count(); ++f) {
            const auto got = (*frames)->frames(f, 1, room);
            if (!got.ok()) status = got.error();
        }
        if (file.fetches() <= fetch) return false;
        EXPECT_TRUE(status.ok() || !status.error().message.empty());
        EXPECT_TRUE(!status.ok() || left > 0);
        return true;
    }
};

} // namespace

TEST_F(Shrinking, AReelFileIsAnErrorAtWhateverFetch)
{
    std::size_t tried = 0;
    for (const codecs::Codec& codec : codecs::all()) {
        EncodeOptions options;
        options.codec = codec.name;
        options.segment = 3;
        if (!codec.exact()) options.quality.step = 0.01;
        const Bytes reel = encode(small_animation(9), options)->bytes;
        for (const std::uint64_t left :
             {std::uint64_t{0}, std::uint64_t{reel.size() / 2}, std::uint64_t{reel.size() - 1}})
            for (std::size_t fetch = 0; decode_while_cut(reel, fetch, left); ++fetch) ++tried;
    }
    EXPECT_GT(tried, 30u);
    std::printf("%zu files cut while they were read\n", tried);
}

TEST_F(Shrinking, FramesThatAreReadWhenNeededAreAnError)
{
    const Animation a = small_animation(9);
    ASSERT_TRUE(io::save(small_animation(1), path("mesh.obj")).ok());
    for (const char* name : {"a.pc2", "a.mdd", "a.###.obj", "a.###.ply", "a.###.off"}) {
        ASSERT_TRUE(io::save(a, path(name)).ok()) << name;
        io::LoadOptions options;
        options.mesh = path("mesh.obj");
        const auto frames = io::open(path(name), options);
        ASSERT_TRUE(frames.ok()) << name << frames.error().sentence();
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            if (entry.path().filename().string()[0] == 'a') std::filesystem::resize_file(entry.path(), 5);
        Matrix<float> room;
        const auto last = (*frames)->frames(8, 1, room); // small files are held, others are not there any more
        EXPECT_TRUE(last.ok() || !last.error().file.empty()) << name;
        EXPECT_FALSE(io::load(path(name), options).ok()) << name;
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            if (entry.path().filename().string()[0] == 'a') std::filesystem::remove(entry.path());
    }
}
