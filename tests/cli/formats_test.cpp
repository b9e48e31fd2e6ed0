/// generate, convert, compare and validate on files that need no codec.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

class Formats : public CommandTest {
protected:
    /// motion.pc2 and its mesh.obj: 60 vertices, 8 frames.
    void make_cache() const { good("generate wave motion.pc2 --mesh mesh.obj --vertices 60 --frames 8 --fps 25"); }
};

TEST_F(Formats, GenerateMakesTheNumbersAskedFor)
{
    const auto json = good("generate wave a.mdd --vertices 77 --frames 9 --fps 50 --seed 3 --json").json();
    EXPECT_EQ(json["schema"], "meshreel.generate/1");
    EXPECT_EQ(json["vertices"], 77);
    EXPECT_EQ(json["frames"], 9);
    EXPECT_DOUBLE_EQ(json["end_s"], 8 / 50.0);
}

TEST_F(Formats, GenerateGivesTheSameBytesForTheSameSeedOnly)
{
    good("generate wave a.pc2 --vertices 60 --seed 1");
    good("generate wave b.pc2 --vertices 60 --seed 1");
    good("generate wave c.pc2 --vertices 60 --seed 2");
    EXPECT_EQ(read("a.pc2"), read("b.pc2"));
    EXPECT_NE(read("a.pc2"), read("c.pc2"));
}

TEST_F(Formats, ConvertThereAndBackGivesTheSamePositions)
{
    make_cache();
    good("convert motion.pc2 --mesh mesh.obj --fps 25 a.####.obj");
    good("convert a.####.obj back.pc2 --fps 25");
    EXPECT_EQ(read("back.pc2").substr(32), read("motion.pc2").substr(32));
}

TEST_F(Formats, ConvertTakesTheFramesAskedFor)
{
    make_cache();
    const auto json = good("convert motion.pc2 --mesh mesh.obj a.mdd --frames 1:6:2 --json").json();
    EXPECT_EQ(json["schema"], "meshreel.convert/1");
    EXPECT_EQ(json["frames"], 3);
    good("convert motion.pc2 --mesh mesh.obj one.obj --frames 4");
    EXPECT_EQ(run("convert motion.pc2 --mesh mesh.obj b.mdd --frames 8:9").exit_code, 1);
}

TEST_F(Formats, APointCacheWithoutItsMeshIsAUsageError)
{
    make_cache();
    EXPECT_EQ(run("convert motion.pc2 a.mdd").exit_code, 1);
}

TEST_F(Formats, EqualAnimationsCompareAsExactlyZero)
{
    make_cache();
    const auto json = good("compare motion.pc2 motion.pc2 --mesh mesh.obj --fail-above kg=0 --json").json();
    EXPECT_EQ(json["schema"], "meshreel.compare/2");
    EXPECT_EQ(json["metrics"]["kg"], 0.0);
    EXPECT_EQ(json["bounds"][0]["met"], true);
    EXPECT_EQ(json["met"], true);
}

TEST_F(Formats, AMissedThresholdExitsSevenAndStillTellsTheFigures)
{
    make_cache();
    good("generate wave other.pc2 --vertices 60 --frames 8 --seed 9");
    const Outcome outcome = run("compare motion.pc2 other.pc2 --mesh mesh.obj --fail-above kg=0.001,sted=9 --json");
    EXPECT_EQ(outcome.exit_code, 7);
    EXPECT_EQ(outcome.json()["met"], false);
    EXPECT_GT(outcome.json()["metrics"]["kg"], 0.001);
    EXPECT_THAT(outcome.err, HasSubstr("--fail-above kg=0.001: KG error is"));
}

TEST_F(Formats, AnimationsOfDifferentSizeAreNotCompared)
{
    make_cache();
    const Outcome outcome = run("compare motion.pc2 mesh.obj --mesh mesh.obj");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("mesh.obj: "));
    EXPECT_THAT(outcome.err, HasSubstr("frame"));
}

TEST_F(Formats, AnimationsOfOtherTrianglesAreComparedBySurfacesAndItIsSaid)
{
    make_cache();
    good("generate wave finer.####.obj --vertices 100 --frames 8");
    const Outcome outcome = good("compare motion.pc2 finer.####.obj --mesh mesh.obj --fps 25 --json");
    EXPECT_THAT(outcome.err, HasSubstr("the original has 60 vertices, the other 100; only measures that need no"));
    EXPECT_GT(outcome.json()["metrics"]["hausdorff"], 0.0);
    EXPECT_FALSE(outcome.json()["metrics"].contains("kg"));
    const Outcome kg = run("compare --metric kg motion.pc2 finer.####.obj --mesh mesh.obj --fps 25");
    EXPECT_EQ(kg.exit_code, 3);
    EXPECT_THAT(kg.err, HasSubstr("kg needs each vertex' counterpart in the other animation"));
}

TEST_F(Formats, ParametersOfMeasuresAreSetAndTold)
{
    make_cache();
    good("generate wave other.pc2 --vertices 60 --frames 8 --seed 9");
    const std::string words = "compare motion.pc2 other.pc2 --mesh mesh.obj --json --metric sted,psnr ";
    const auto usual = good(words).json(), narrow = good(words + "--set sted.window=2").json();
    EXPECT_NE(usual["metrics"]["sted_temporal"], narrow["metrics"]["sted_temporal"]);
    EXPECT_EQ(narrow["values"][1]["parameters"]["window"], 2);
    EXPECT_EQ(narrow["values"][0]["name"], "psnr");
    EXPECT_EQ(narrow["values"][0]["better"], "more");
    EXPECT_EQ(run(words + "--set sted.windw=2").exit_code, 1);
    EXPECT_EQ(run(words + "--set sted.window=0").exit_code, 1);
    EXPECT_EQ(run(words + "--fail-below psnr=900").exit_code, 7);
    EXPECT_EQ(run(words + "--fail-below psnr").exit_code, 1);
}

TEST_F(Formats, ValidateSaysWhatAFileIs)
{
    make_cache();
    const auto json = good("validate motion.pc2 --mesh mesh.obj --json").json();
    EXPECT_EQ(json["schema"], "meshreel.validate/1");
    EXPECT_EQ(json["valid"], true);
    EXPECT_EQ(json["topology"]["boundary_loops"], 1);
    EXPECT_THAT(good("validate mesh.obj").out, HasSubstr("valid obj: 60 vertices"));
}

TEST_F(Formats, ValidateNamesByteAndFieldOfABrokenFile)
{
    make_cache();
    write("cut.pc2", read("motion.pc2").substr(0, 200));
    const Outcome outcome = run("validate cut.pc2 --mesh mesh.obj --json");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.json()["valid"], false);
    EXPECT_EQ(outcome.json()["problems"][0]["byte"], 32);
    EXPECT_EQ(outcome.json()["problems"][0]["field"], "positions");
    EXPECT_THAT(outcome.err, HasSubstr("cut.pc2: byte 32: positions: "));
}

TEST_F(Formats, ValidateNamesTheLineOfABrokenText)
{
    write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n");
    const Outcome outcome = run("validate bad.obj --json");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.json()["problems"][0]["line"], 3);
}

TEST_F(Formats, BrokenInputLeavesNoOutput)
{
    make_cache();
    write("cut.pc2", read("motion.pc2").substr(0, 200));
    const auto before = files();
    EXPECT_EQ(run("convert cut.pc2 --mesh mesh.obj a.mdd").exit_code, 3);
    EXPECT_EQ(run("convert motion.pc2 --mesh nothing.obj a.mdd").exit_code, 2);
    EXPECT_EQ(run("convert motion.pc2 --mesh mesh.obj a.mdd --max-memory 1K").exit_code, 3);
    EXPECT_EQ(files(), before);
}
