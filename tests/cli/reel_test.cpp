/// encode, decode, info and explain, and .reel files wherever an animation may stand.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

class Reel : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        good("generate wave motion.pc2 --mesh mesh.obj --vertices 120 --frames 12 --fps 25");
    }
    void make_reel(const std::string& options = "") const
    {
        good("encode motion.pc2 --mesh mesh.obj --fps 25 a.reel " + options);
    }
    /// The metrics of a.reel against what it was made from.
    nlohmann::json metrics(const std::string& options = "") const
    {
        return good("compare motion.pc2 a.reel --mesh mesh.obj --json " + options).json()["metrics"];
    }
};

TEST_F(Reel, WithoutAFlagNobodySeesADifference)
{
    make_reel();
    EXPECT_LE(metrics()["sted"], 0.02);
    EXPECT_LE(metrics()["max_error_relative"], 1.0);
    EXPECT_LT(read("a.reel").size(), read("motion.pc2").size());
}

TEST_F(Reel, TheErrorAskedForIsMet)
{
    make_reel("--max-error 0.01%");
    EXPECT_LE(metrics()["max_error_relative"], 0.01);
    make_reel("--max-error 0.02 -y");
    EXPECT_LE(metrics()["max_error"], 0.02);
    make_reel("--kg 0.5 -y");
    EXPECT_LE(metrics()["kg"], 0.5);
}

TEST_F(Reel, EveryKindOfTargetIsMetAndSaid)
{
    const auto reached = [&](const std::string& target, const char* name) {
        return good("encode motion.pc2 --mesh mesh.obj a.reel -y --json " + target).json()[name].get<double>();
    };
    EXPECT_LE(reached("--sted 0.01", "sted"), 0.01);
    EXPECT_GE(reached("--psnr 50", "psnr"), 50.0);
    EXPECT_LE(reached("--size 2k", "reel_bytes"), 2048.0);
    EXPECT_LE(reached("--bpfv 12", "bpfv"), 12.0);
}

TEST_F(Reel, TargetsExcludeEachOtherByName)
{
    const Outcome outcome = run("encode motion.pc2 --mesh mesh.obj a.reel --kg 1 --psnr 50");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("--kg"), HasSubstr("--psnr")));
    EXPECT_EQ(run("encode motion.pc2 --mesh mesh.obj a.reel --effort 10").exit_code, 1);
}

TEST_F(Reel, ASizeThatNothingFitsIntoIsMissed)
{
    EXPECT_EQ(run("encode motion.pc2 --mesh mesh.obj a.reel --size 100").exit_code, 7);
    EXPECT_FALSE(exists("a.reel"));
}

TEST_F(Reel, WhatEncodeSaysItReachedIsWhatCompareMeasures)
{
    const auto json = good("encode motion.pc2 --mesh mesh.obj a.reel --kg 0.1 --json").json();
    EXPECT_NEAR(json["kg"], metrics()["kg"], 1e-9);
    EXPECT_NEAR(json["max_error_relative"], metrics()["max_error_relative"], 1e-9);
    EXPECT_NEAR(json["psnr"], metrics()["psnr"], 1e-9);
    EXPECT_EQ(json["reel_bytes"], read("a.reel").size());
    EXPECT_DOUBLE_EQ(json["bpfv"], 8.0 * static_cast<double>(read("a.reel").size()) / (120.0 * 12.0));
}

TEST_F(Reel, TheProcessorsSecondsAreToldBesideTheWalls)
{
    EXPECT_GT(good("encode motion.pc2 --mesh mesh.obj a.reel --kg 0.1 --json").json()["encode_processor_seconds"], 0.0);
    EXPECT_GE(good("decode a.reel a.pc2 --json").json()["decode_processor_seconds"], 0.0);
}

TEST_F(Reel, BasesAndStepCanBeSetByHand)
{
    const auto json = good("encode motion.pc2 --mesh mesh.obj a.reel --bases 1 --step 0.001 --json").json();
    EXPECT_EQ(json["bases"], 1);
    EXPECT_EQ(json["step"], 0.001);
}

TEST_F(Reel, EveryWayOfCodingComesBack)
{
    for (const char* basis : {"raw", "uniform", "cobra"})
        for (const char* entropy : {"huffman", "range"}) {
            make_reel(std::string("-y --basis ") + basis + " --entropy " + entropy);
            EXPECT_LE(metrics()["sted"], 0.02) << basis << " " << entropy;
        }
}

TEST_F(Reel, DecodeGivesTheOrderTheTimesAndTheFrames)
{
    make_reel();
    good("decode a.reel back.pc2 --mesh-out back.obj");
    EXPECT_EQ(read("back.pc2").size(), read("motion.pc2").size());
    EXPECT_EQ(read("back.pc2").substr(0, 32), read("motion.pc2").substr(0, 32));
    good("decode a.reel back.mdd --frames 2:8:3");
    EXPECT_EQ(good("info back.mdd --mesh mesh.obj --json").json()["frames"], 3);
}

TEST_F(Reel, LosslessGivesBackTheVeryBytes)
{
    make_reel("--lossless");
    good("decode a.reel back.pc2");
    EXPECT_EQ(read("back.pc2"), read("motion.pc2"));
    EXPECT_LT(read("a.reel").size(), read("motion.pc2").size() / 2);
    EXPECT_THAT(good("explain a.reel").out, HasSubstr("x.decimal"));
    EXPECT_EQ(run("encode motion.pc2 --mesh mesh.obj b.reel --lossless --kg 1").exit_code, 1);
}

TEST_F(Reel, DecodeShowsAnyRate)
{
    make_reel();
    good("decode a.reel fast.mdd --fps 100");
    EXPECT_EQ(good("info fast.mdd --mesh mesh.obj --json").json()["frames"], 45);
    good("decode a.reel same.pc2 --fps 25");
    good("decode a.reel back.pc2");
    EXPECT_EQ(read("same.pc2"), read("back.pc2"));
    EXPECT_THAT(run("decode a.reel other.pc2 --fps 50 --frames ::2").err, HasSubstr("steps"));
}

TEST_F(Reel, DecodeGivesCoarserLevelsThatInfoMeasures)
{
    good("generate jelly jelly.pc2 --mesh-out jelly.obj --vertices 1000 --frames 8");
    good("encode jelly.pc2 --mesh jelly.obj a.reel --step 0.001");
    const auto levels = good("info a.reel --levels --json").json()["levels"];
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(good("info a.reel --json").json()["levels"][1]["bytes"], levels[1]["bytes"]);
    write("part.reel", read("a.reel").substr(0, levels[1]["bytes"].get<std::size_t>()));
    const auto coarse = good("decode part.reel b.pc2 --level 1 --json").json();
    EXPECT_EQ(coarse["vertices"], levels[1]["vertices"]);
    EXPECT_EQ(coarse["triangles"], levels[1]["triangles"]);
    EXPECT_GT(levels[2]["rms_error_relative"], levels[1]["rms_error_relative"]);
    EXPECT_THAT(good("info a.reel --levels").out, HasSubstr("rms error"));
}

TEST_F(Reel, ALevelThatIsNotThereIsNamed)
{
    make_reel();
    EXPECT_THAT(run("decode a.reel b.pc2 --level 7").err, HasSubstr("there is no level 7; the coarsest is"));
    make_reel("-y --codec coddyac");
    EXPECT_THAT(run("decode a.reel b.pc2 --level 1").err, HasSubstr("the codec coddyac has no levels of detail"));
}

TEST_F(Reel, LongAnimationsAreCutWhereOneSays)
{
    const auto segments = [this] {
        const auto chunks = good("info a.reel --json").json()["chunks"];
        return std::ranges::count_if(chunks, [](const auto& chunk) { return chunk["type"] == "SEGM"; });
    };
    make_reel("--segment 5");
    EXPECT_EQ(segments(), 3);
    good("decode a.reel all.mdd");
    good("decode a.reel some.mdd --frames 4:7");
    EXPECT_EQ(read("some.mdd").substr(24), read("all.mdd").substr(56 + 4 * 120 * 12, 4 * 120 * 12));
    make_reel("-y --segment none");
    EXPECT_EQ(segments(), 1);
    EXPECT_EQ(run("encode motion.pc2 --mesh mesh.obj b.reel --segment 0").exit_code, 1);
}

TEST_F(Reel, DecodeWritesASequence)
{
    make_reel();
    good("decode a.reel back.####.obj");
    EXPECT_TRUE(exists("back.0000.obj") && exists("back.0011.obj"));
    EXPECT_FALSE(exists("back.0012.obj"));
    good("compare a.reel back.####.obj --fps 25 --fail-above max_error_relative=0.0001");
}

TEST_F(Reel, ABaseMeshOnBothSidesNeedsNoConnectivity)
{
    make_reel();
    const std::size_t with_mesh = read("a.reel").size();
    make_reel("--base mesh.obj -y");
    EXPECT_LT(read("a.reel").size(), with_mesh);
    EXPECT_LE(metrics("--base mesh.obj")["sted"], 0.02);
    good("decode a.reel back.pc2 --base mesh.obj");
    EXPECT_NE(run("decode a.reel other.pc2").exit_code, 0);
    EXPECT_FALSE(exists("other.pc2"));
}

TEST_F(Reel, TheWrongBaseMeshIsRefused)
{
    make_reel("--base mesh.obj");
    good("generate wave wrong.obj --vertices 121 --frames 1");
    const Outcome outcome = run("decode a.reel back.pc2 --base wrong.obj");
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_FALSE(exists("back.pc2"));
}

TEST_F(Reel, AFileWithoutOrderIsComparedInItsOwn)
{
    make_reel("--order free");
    EXPECT_EQ(good("info a.reel --json").json()["order"], "free");
    EXPECT_LE(metrics()["sted"], 0.02);
    good("decode a.reel free.pc2");
    good("compare motion.pc2 free.pc2 --mesh mesh.obj --order free --fail-above sted=0.02");
    EXPECT_EQ(run("compare motion.pc2 free.pc2 --mesh mesh.obj --fail-above sted=0.02").exit_code, 7);
}

TEST_F(Reel, AFileGoesThroughPipes)
{
    make_reel();
    const Outcome piped = good("encode motion.pc2 --mesh mesh.obj --fps 25 -");
    EXPECT_EQ(piped.out, read("a.reel"));
    good("decode a.reel there.pc2");
    EXPECT_EQ(good("decode - - --format pc2", {.input = piped.out}).out, read("there.pc2"));
    good("info -  --format reel", {.input = piped.out});
    good("validate - --format reel", {.input = piped.out});
    EXPECT_EQ(good("explain -", {.input = piped.out}).out, good("explain a.reel").out);
}

TEST_F(Reel, ConvertTakesAndGivesReels)
{
    make_reel();
    good("convert a.reel b.pc2");
    good("decode a.reel c.pc2");
    EXPECT_EQ(read("b.pc2"), read("c.pc2"));
    good("convert motion.pc2 --mesh mesh.obj --fps 25 d.reel");
    EXPECT_EQ(read("d.reel"), read("a.reel"));
    good("convert a.reel e.pc2 --fps 50");
    EXPECT_EQ(good("info e.pc2 --mesh mesh.obj --json").json()["frames"], 23);
}

TEST_F(Reel, TheThreadsDoNotChangeTheBytes)
{
    make_reel("--threads 1");
    const std::string one = read("a.reel");
    make_reel("--threads 2 -y");
    EXPECT_EQ(read("a.reel"), one);
}

TEST_F(Reel, InfoTellsWithoutTheMesh)
{
    make_reel();
    const auto json = good("info a.reel --json").json();
    EXPECT_EQ(json["vertices"], 120);
    EXPECT_EQ(json["frames"], 12);
    EXPECT_EQ(json["codec"], "reel");
    EXPECT_EQ(json["meta"]["fps"], 25.0);
    EXPECT_EQ(json["file_bytes"], read("a.reel").size());
}

TEST_F(Reel, ExplainStartsAtByteZeroAndNamesTheChunks)
{
    make_reel();
    const std::string text = good("explain a.reel").out;
    const auto chunks = good("info a.reel --json").json()["chunks"];
    EXPECT_GE(chunks.size(), 4u);
    EXPECT_THAT(text, testing::ContainsRegex("\n +0 +8 "));
    for (const auto& chunk : chunks) EXPECT_THAT(text, HasSubstr(chunk["type"].get<std::string>()));
}

TEST_F(Reel, ATruncatedFileIsRefusedAndLeavesNothing)
{
    make_reel();
    const std::string whole = read("a.reel");
    for (std::size_t size = 0; size < whole.size(); size += std::max<std::size_t>(1, whole.size() / 20)) {
        write("cut.reel", whole.substr(0, size));
        const Outcome outcome = run("decode cut.reel back.pc2");
        EXPECT_EQ(outcome.exit_code, 3) << size << " of " << whole.size();
        EXPECT_THAT(outcome.err, HasSubstr("cut.reel: "));
        EXPECT_FALSE(exists("back.pc2"));
        EXPECT_EQ(run("validate cut.reel").exit_code, 3);
    }
}

TEST_F(Reel, AFlippedBitIsFoundByValidate)
{
    make_reel();
    const std::string whole = read("a.reel");
    for (std::size_t byte = 0; byte < whole.size(); byte += std::max<std::size_t>(1, whole.size() / 20)) {
        std::string broken = whole;
        broken[byte] = static_cast<char>(broken[byte] ^ 0x10);
        write("broken.reel", broken);
        const int code = run("validate broken.reel").exit_code;
        EXPECT_TRUE(code == 3 || code == 5) << "byte " << byte << ": " << code;
    }
}

TEST_F(Reel, SomethingElseIsNotAReel)
{
    good("convert motion.pc2 --mesh mesh.obj x.mdd");
    write("x.reel", read("x.mdd"));
    const Outcome outcome = run("decode x.reel y.pc2 --json");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.json()["error"]["file"], "x.reel");
    EXPECT_TRUE(outcome.json()["error"].contains("byte"));
}

TEST_F(Reel, TheSpeedGivenIsThatOfTheFileThatHasNone)
{
    good("encode motion.pc2 --mesh mesh.obj --fps 50 a.reel");
    good("compare motion.pc2 a.reel --mesh mesh.obj --fps 50");
    good("picture motion.pc2 a.reel a.svg --mesh mesh.obj --fps 50");
    good("compare a.reel motion.pc2 --mesh mesh.obj --fps 50");
}

TEST_F(Reel, QualitiesContradictEachOther)
{
    for (const char* words : {"--kg 1 --max-error 1%", "--bases 3 --kg 1", "--step 0.1 --max-error 1%"})
        EXPECT_EQ(run(std::string("encode motion.pc2 --mesh mesh.obj b.reel ") + words).exit_code, 1) << words;
    for (const char* words : {"--kg 0", "--max-error -1%", "--max-error x", "--bases 0", "--step nan", "--order any"})
        EXPECT_EQ(run(std::string("encode motion.pc2 --mesh mesh.obj b.reel ") + words).exit_code, 1) << words;
    EXPECT_FALSE(exists("b.reel"));
}

TEST_F(Reel, AFullDiskLeavesNoReel)
{
    EXPECT_EQ(run("encode motion.pc2 --mesh mesh.obj a.reel", {.largest_file = 100}).exit_code, 2);
    EXPECT_FALSE(exists("a.reel"));
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(Reel, ANumberThatIsNoneIsNamedByFrameAndVertex)
{
    std::string broken = read("motion.pc2");
    const std::size_t at = 32 + 12 * (120 * 3 + 7); // frame 3, vertex 7
    broken.replace(at, 4, std::string("\x00\x00\xc0\x7f", 4));
    write("nan.pc2", broken);
    const Outcome outcome = run("encode nan.pc2 --mesh mesh.obj b.reel");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("frame 3"), HasSubstr("vertex 7")));
    EXPECT_FALSE(exists("b.reel"));
}
