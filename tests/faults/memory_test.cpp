/// A machine without memory: whatever allocation of a call fails, the call ends in an error and holds nothing.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>

#include "meshreel/codecs/codec.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/meshreel.h"
#include "meshreel/player/player.h"
#include "tests/faults/file.h"
#include "tests/faults/memory.h"

using namespace meshreel;
using faults::Scarcity;

namespace {

/// Says the sum as the last line.
class OutOfMemory : public testing::Test {
protected:
    static void TearDownTestSuite() { std::printf("%zu failing allocations tried\n", tried_); }

    /// What became of a call: nothing that a test would have to allocate.
    struct Outcome {
        bool ok, clear;
    };

    template <class T>
    static Outcome outcome_of(const Result<T>& result)
    {
        return {result.ok(),
                !result.ok() && result.error().code == ErrorCode::runtime && result.error().message == "out of memory"};
    }

    /// Every `stride`th allocation of a call fails, once and for good; fewer under a sanitizer, which is slow.
    static void run_out(const char* name, const std::function<Outcome()>& call, std::size_t stride = 1)
    {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        stride *= 7;
#endif
        ASSERT_TRUE(call().ok) << name; // what is made once is there from now on
        std::size_t all = 0;
        {
            const Scarcity counting;
            (void)call();
            all = counting.asked();
        }
        ASSERT_GT(all, 0u) << name;
        for (const Scarcity::Of of : {Scarcity::Of::one, Scarcity::Of::all_from_there})
            for (std::size_t i = 0; i < all; i += stride) run_out_at(name, call, i, of);
        std::printf("%s: %zu allocations\n", name, all);
    }

private:
    static void run_out_at(const char* name, const std::function<Outcome()>& call, std::size_t i, Scarcity::Of of)
    {
        const std::size_t before = faults::held();
        Outcome outcome{};
        {
            const Scarcity scarcity(i, of);
            outcome = call();
        }
        ++tried_;
        EXPECT_TRUE(outcome.clear || outcome.ok) << name << ", allocation " << i;
        EXPECT_LE(faults::held(), before) << name << ", allocation " << i << " left memory behind";
    }

    static inline std::size_t tried_ = 0;
};

Animation small_animation()
{
    Animation a = test_shapes::two_components();
    a.positions.resize(6 * 3 * a.vertex_count);
    a.times_s = uniform_times(6, 25.0);
    return a;
}

io::SaveOptions overwriting()
{
    io::SaveOptions options;
    options.overwrite = true;
    return options;
}

io::LoadOptions with_mesh(const std::string& mesh)
{
    io::LoadOptions options;
    options.mesh = mesh;
    return options;
}

} // namespace

TEST_F(OutOfMemory, ADecoderGivesAnError)
{
    for (const codecs::Codec& codec : codecs::all()) {
        const Bytes file = faults::small_file(std::string(codec.name));
        run_out(("decode " + std::string(codec.name)).c_str(), [&] {
            DecodeOptions options;
            options.threads = {1};
            return outcome_of(decode(file, options));
        });
    }
}

TEST_F(OutOfMemory, ADecoderOfPartsAndLevelsGivesAnError)
{
    const Bytes file = faults::small_file("reel");
    const Bytes levels = faults::golden_file("reel_v1_levels_cloth");
    run_out(
        "decode a level of parts",
        [&] {
            DecodeOptions options;
            options.threads = {1};
            options.level = 1;
            MemorySource source(levels);
            return outcome_of(decode(source, options));
        },
        17);
    run_out("decode frame by frame", [&] {
        DecodeOptions options;
        options.threads = {1};
        MemorySource source(file);
        const auto frames = open_frames(source, options);
        if (!frames.ok()) return outcome_of(frames);
        Matrix<float> room;
        return outcome_of((*frames)->frames(0, 6, room));
    });
}

TEST_F(OutOfMemory, WithThreadsTooOrTheyAreFewer)
{
    const Bytes file = faults::small_file("reel");
    run_out("decode with three threads", [&] {
        DecodeOptions options;
        options.threads = {3};
        return outcome_of(decode(file, options));
    });
}

TEST_F(OutOfMemory, APlayerAndTheInspectorsGiveAnError)
{
    const Bytes file = faults::small_file("reel");
    run_out("open a player", [&] {
        player::OpenOptions options;
        options.threads = {1};
        return outcome_of(player::Player::open(file, options));
    });
    run_out("info", [&] { return outcome_of(info(file)); });
    run_out("explain", [&] { return outcome_of(explain(file)); });
    run_out("levels", [&] {
        DecodeOptions options;
        options.threads = {1};
        return outcome_of(levels(file, options));
    });
}

TEST_F(OutOfMemory, AnEncoderGivesAnError)
{
    const Animation a = small_animation();
    for (const codecs::Codec& codec : codecs::all())
        run_out(("encode " + std::string(codec.name)).c_str(),
                [&] {
                    EncodeOptions options;
                    options.codec = codec.name;
                    if (!codec.exact()) options.quality.step = 0.01;
                    options.effort = 1;
                    options.threads = {1};
                    return outcome_of(encode(a, options));
                },
                197);
}

// But glTF: the JSON library ends the program where its destructors find no memory.
TEST_F(OutOfMemory, ReadersAndWritersGiveAnErrorAndLeaveNoFile)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "meshreel-out-of-memory";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const Animation a = small_animation();
    for (const char* name : {"a.obj", "a.ply", "a.off"}) {
        Animation one = a;
        one.times_s.resize(1);
        one.positions.resize(3 * a.vertex_count);
        const std::string path = (folder / name).string();
        run_out(("save " + std::string(name)).c_str(), [&] { return outcome_of(io::save(one, path, overwriting())); });
        run_out(("load " + std::string(name)).c_str(), [&] { return outcome_of(io::load(path)); });
    }
    const io::LoadOptions with_mesh_a = with_mesh((folder / "a.obj").string());
    const io::SaveOptions onto_itself = overwriting();
    for (const char* name : {"a.pc2", "a.mdd"}) {
        const std::string path = (folder / name).string();
        run_out(("save " + std::string(name)).c_str(), [&] { return outcome_of(io::save(a, path, onto_itself)); });
        run_out(("load " + std::string(name)).c_str(), [&] { return outcome_of(io::load(path, with_mesh_a)); });
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 5);
    fs::remove_all(folder);
}
