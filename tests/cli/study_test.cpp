/// study: correlations of a table, for people, for programs and as a picture.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

class Study : public CommandTest {
protected:
    const std::string thesis_ = MESHREEL_SOURCE_DIR "/tests/metrics/study/table_7_3.csv";
};

TEST_F(Study, PrintsTheThesisCorrelations)
{
    const std::string out = good("study correlate " + thesis_).out;
    EXPECT_THAT(out, HasSubstr("27 stimuli against MOS"));
    EXPECT_THAT(out, HasSubstr("TD error           9   0.814 [ 0.327,  0.960]"));
    EXPECT_THAT(out, HasSubstr("fewer than 3 pairs"));
    EXPECT_THAT(out, testing::Not(HasSubstr("nan")));
}

TEST_F(Study, GivesJsonADatasetAMeasureAndAllTogether)
{
    const auto json = good("study correlate " + thesis_ + " --measure RMS --json").json();
    EXPECT_EQ(json["datasets"].size(), 3u);
    ASSERT_EQ(json["correlations"].size(), 4u);
    EXPECT_EQ(json["correlations"][0]["dataset"], "chicken");
    EXPECT_TRUE(json["correlations"][3]["dataset"].is_null());
    EXPECT_EQ(json["correlations"][3]["pairs"], 27);
    EXPECT_NEAR(json["correlations"][0]["pearson"]["value"].get<double>(), -0.6885, 1e-4);
}

TEST_F(Study, SaysInsteadOfANumberWhyThereIsNone)
{
    write("flat.csv", "name,MOS,kg\na,1,2\nb,2,2\nc,3,2\n");
    const auto one = good("study correlate flat.csv --json").json()["correlations"][0]["kendall"];
    EXPECT_TRUE(one["value"].is_null());
    EXPECT_EQ(one["lacking"], "the measure is constant");
}

TEST_F(Study, DrawsAPictureButNotOverAFile)
{
    good("study correlate " + thesis_ + " --plot all.svg");
    EXPECT_THAT(read("all.svg"), HasSubstr("TD error, r = "));
    EXPECT_EQ(run("study correlate " + thesis_ + " --plot all.svg").exit_code, 1);
    good("study correlate " + thesis_ + " --plot all.svg -y");
}

TEST_F(Study, ReadsStandardInput)
{
    EXPECT_THAT(good("study correlate -", {.input = "MOS,kg\n1,2\n2,3\n3,5\n"}).out, HasSubstr("3 stimuli"));
}

TEST_F(Study, NamesFileLineAndColumnOfWhatIsWrong)
{
    write("bad.csv", "name,MOS,kg\na,1,2\nb,2,x\n");
    const Outcome outcome = run("study correlate bad.csv --plot bad.svg");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("bad.csv: line 3: column 'kg': 'x' is not a finite number"));
    EXPECT_FALSE(exists("bad.svg"));
    EXPECT_EQ(run("study correlate none.csv").exit_code, 2);
    EXPECT_EQ(run("study correlate bad.csv --measure x").exit_code, 1);
    EXPECT_EQ(run("study explain bad.csv").exit_code, 1);
}
