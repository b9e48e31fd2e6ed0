/// The command on a machine that fails: killed at any moment, or written to by nobody any more.
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <random>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

namespace {

class Killed : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        good("generate wave a.glb --vertices 400 --frames 40");
        good("encode a.glb a.reel --kg 1 --effort 1");
    }

    /// Runs a command that makes `output`, again and again, and kills it at random moments: what has that name is the old
    /// file or the new one.
    void kill_often(const std::string& words, const std::string& output)
    {
        const auto start = std::chrono::steady_clock::now();
        good(words);
        const auto most =
            std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
        const std::string whole = read(output), old = "what was there";
        std::mt19937 random(1);
        int killed = 0, done = 0;
        for (int i = 0; i < 25; ++i) {
            write(output, old);
            meshreel::cli_test::Start dying;
            dying.killed_after_us =
                static_cast<unsigned>(1 + random() % static_cast<unsigned long>(most.count() * 5 / 4));
            const Outcome outcome = run(words, dying);
            (outcome.exit_code == 128 + 9 ? killed : done) += 1;
            const std::string there = read(output);
            EXPECT_TRUE(there == old || there == whole) << there.size() << " bytes";
            EXPECT_TRUE(outcome.exit_code != 0 || there == whole);
        }
        good(words); // what the killed ones left is in nobody's way
        EXPECT_TRUE(read(output) == whole);
        for (const std::string& name : files())
            EXPECT_TRUE(name == "a.glb" || name == "a.reel" || name == output || name.ends_with(".tmp")) << name;
        EXPECT_GT(killed, 0);
        std::printf("%s: killed %d times, done %d times\n", words.c_str(), killed, done);
    }
};

} // namespace

TEST_F(Killed, AnEncoderLeavesTheOldFileOrTheNewOne)
{
    kill_often("encode a.glb b.reel --kg 1 --effort 1 -y", "b.reel");
}

TEST_F(Killed, ADecoderLeavesTheOldFileOrTheNewOne)
{
    kill_often("decode a.reel b.pc2 -y", "b.pc2");
}

TEST_F(Killed, AConverterLeavesNothingThatASequenceWouldTake)
{
    std::mt19937 random(2);
    int killed = 0;
    for (int i = 0; i < 30; ++i) {
        meshreel::cli_test::Start dying;
        dying.killed_after_us = static_cast<unsigned>(1 + random() % 30'000);
        killed += run("convert a.glb c.###.obj -y", dying).exit_code == 128 + 9;
    }
    EXPECT_GT(killed, 0);
    std::printf("killed %d times\n", killed);
    good("convert a.glb c.###.obj -y");
    EXPECT_EQ(good("info c.###.obj --json").json()["frames"], 40);
}

TEST_F(CommandTest, APipeThatIsClosedIsAnError)
{
    good("generate wave a.glb --vertices 3000 --frames 60");
    good("encode a.glb a.reel --kg 5 --effort 1");
    const std::string pipe = (folder_ / "pipe").string();
    for (const char* words :
         {"convert a.glb - --to pc2", "decode a.reel - --format mdd", "encode a.glb - --lossless --effort 1"}) {
        ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        std::thread reader([&] {
            const int end = ::open(pipe.c_str(), O_RDONLY);
            ::fcntl(end, F_SETPIPE_SZ, 4096); // less than is written
            char first[10];
            (void)!::read(end, first, sizeof first);
            ::close(end);
        });
        meshreel::cli_test::Start start;
        start.output_file = pipe;
        const Outcome outcome = run(words, start);
        reader.join();
        EXPECT_EQ(outcome.exit_code, 2) << words;
        EXPECT_THAT(outcome.err, HasSubstr("Broken pipe")) << words;
        ::unlink(pipe.c_str());
    }
}
