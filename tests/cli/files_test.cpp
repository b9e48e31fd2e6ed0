/// What the command does to files: it never overwrites unasked, and never leaves half of one.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;

class Files : public CommandTest {};

TEST_F(Files, AnExistingFileIsOverwrittenOnlyWithY)
{
    write("a.mdd", "mine");
    EXPECT_EQ(run("generate wave a.mdd --vertices 50").exit_code, 1);
    EXPECT_EQ(read("a.mdd"), "mine");
    good("generate wave a.mdd --vertices 50 -y");
    EXPECT_NE(read("a.mdd"), "mine");
}

TEST_F(Files, AFrameOfASequenceCountsAsExisting)
{
    write("a.0007.obj", "mine");
    const Outcome outcome = run("generate wave a.####.obj --vertices 50 --frames 3");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("a.0007.obj"));
    EXPECT_THAT(files(), ElementsAre("a.0007.obj"));
}

TEST_F(Files, SkipExistingLeavesTheFileAndSucceeds)
{
    write("a.mdd", "mine");
    EXPECT_EQ(good("generate wave a.mdd --skip-existing --json").json()["skipped"], true);
    EXPECT_EQ(read("a.mdd"), "mine");
    EXPECT_EQ(good("generate wave b.mdd --vertices 50 --skip-existing --json").json()["skipped"], false);
}

TEST_F(Files, TheInputIsNeverTheOutput)
{
    good("generate wave a.obj --vertices 50 --frames 1");
    const std::string before = read("a.obj");
    for (const char* words :
         {"convert a.obj a.obj -y", "convert a.obj ./a.obj -y", "convert x.pc2 --mesh a.obj a.obj -y"})
        EXPECT_THAT(run(words).err, HasSubstr("is the input too")) << words;
    EXPECT_EQ(read("a.obj"), before);
}

TEST_F(Files, AFullDiskLeavesNothing)
{
    const Outcome outcome = run("generate wave a.pc2 --vertices 1000 --frames 20", {.largest_file = 8192});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("a.pc2: cannot write"));
    EXPECT_TRUE(files().empty());
}

TEST_F(Files, AFullDiskInTheMiddleOfASequenceLeavesNothing)
{
    good("generate wave small.obj --vertices 10 --frames 1");
    EXPECT_EQ(run("generate wave a.####.obj --vertices 1000 --frames 5", {.largest_file = 8192}).exit_code, 2);
    EXPECT_THAT(files(), ElementsAre("small.obj"));
}

TEST_F(Files, AFullDeviceOnStandardOutputIsAnError)
{
    EXPECT_EQ(run("generate wave - --format pc2", {.output_file = "/dev/full"}).exit_code, 2);
    EXPECT_EQ(run("generate wave a.mdd --vertices 50 --json", {.output_file = "/dev/full"}).exit_code, 2);
    EXPECT_EQ(run("--help", {.output_file = "/dev/full"}).exit_code, 2);
    EXPECT_EQ(run("generate wave /dev/full --format pc2").exit_code, 2);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(Files, OldMeshIsThereAgainWhereTheRestFails)
{
    good("generate wave a.pc2 --mesh-out a.obj --vertices 50");
    write("old.obj", "what was there");
    for (const std::string command :
         {"generate wave /dev/full --format pc2", "convert a.pc2 --mesh a.obj /dev/full --to pc2"}) {
        EXPECT_EQ(run(command + " -y --mesh-out old.obj").exit_code, 2) << command;
        EXPECT_EQ(read("old.obj"), "what was there");
        EXPECT_EQ(run(command + " --mesh-out new.obj").exit_code, 2);
    }
    EXPECT_THAT(files(), ElementsAre("a.obj", "a.pc2", "old.obj"));
}

TEST_F(Files, AFullDeviceOnStandardErrorDoesNoHarm)
{
    EXPECT_EQ(run("generate wave a.mdd --vertices 50", {.error_file = "/dev/full"}).exit_code, 0);
    EXPECT_EQ(run("generate wave a.mdd --vertices 50", {.error_file = "/dev/full"}).exit_code, 1);
    EXPECT_TRUE(exists("a.mdd"));
}

TEST_F(Files, AMissingFolderIsSaidBeforeTheWork)
{
    const Outcome outcome = run("generate wave no/where/a.pc2 --vertices 1000000 --frames 1000");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("there is no folder no/where"));
}

TEST_F(Files, AFolderThatTakesNoFilesIsAnError)
{
    const Outcome outcome = run("generate wave /proc/a.pc2 --vertices 50");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("/proc/a.pc2: cannot write"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they need the address space themselves
TEST_F(Files, TooLittleMemoryIsASentence)
{
    const Outcome outcome = run("generate wave a.pc2 --vertices 300000 --frames 2000", {.largest_memory = 1u << 30});
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("out of memory"));
    EXPECT_TRUE(files().empty());
}
#endif

TEST_F(Files, AMeshThatCannotBeWrittenTakesTheCacheWithIt)
{
    EXPECT_EQ(run("generate wave a.pc2 --vertices 50 --mesh no/a.obj").exit_code, 2);
    EXPECT_EQ(run("generate wave a.pc2 --vertices 50 --mesh a.obj", {.largest_file = 10000}).exit_code, 2);
    EXPECT_TRUE(files().empty());
}

TEST_F(Files, AnInterruptLeavesNoTemporaryFile)
{
    const Outcome outcome =
        run("generate wave a.####.obj --vertices 3000 --frames 2000", {.interrupt_at_first_file = true});
    EXPECT_EQ(outcome.exit_code, 128 + 2);
    EXPECT_TRUE(files().empty()) << files().size();
}

TEST_F(Files, DataGoThroughStandardInputAndOutput)
{
    good("generate wave a.obj --vertices 50 --frames 1");
    const Outcome piped = good("generate wave - --format obj --vertices 50 --frames 1");
    EXPECT_EQ(piped.out, read("a.obj"));
    good("convert - b.mdd --from obj", {.input = piped.out});
    good("convert a.obj c.mdd");
    EXPECT_EQ(read("b.mdd"), read("c.mdd"));
}

TEST_F(Files, StandardOutputIsNotSharedWithJson)
{
    const Outcome outcome = run("generate wave - --format pc2 --vertices 50 --json");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.json()["error"]["code"], "usage");
}

TEST_F(Files, AnUnknownExtensionIsUnsupported)
{
    EXPECT_EQ(run("generate wave a.foo").exit_code, 5);
    EXPECT_EQ(run("validate a.foo").exit_code, 5);
}
