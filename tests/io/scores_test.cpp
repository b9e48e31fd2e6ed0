/// Tables of scores: what is forgiven, and what is an error with its line and column.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/io/scores.h"

using namespace meshreel;

namespace {

Result<io::Scores> scores_of(std::string_view text, const io::ScoreColumns& columns = {})
{
    MESHREEL_TRY(const io::Csv csv, io::parse_csv({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    return io::read_scores(csv, columns);
}

std::string problem(std::string_view text, const io::ScoreColumns& columns = {})
{
    const auto scores = scores_of(text, columns);
    return scores.ok() ? "none" : scores.error().sentence();
}

} // namespace

TEST(Scores, AreReadFromAPlainTable)
{
    const auto scores = *scores_of("dataset,stimulus,MOS,kg,sted\nwalk,a,1.5,0.1,2e-3\nrun,a,7,0.4,0.5\n");
    ASSERT_EQ(scores.stimuli.size(), 2u);
    EXPECT_EQ(scores.datasets, (std::vector<std::string>{"walk", "run"}));
    EXPECT_EQ(scores.stimuli[1].mos, 7.0);
    EXPECT_EQ(scores.stimuli[1].dataset, 1u);
    EXPECT_EQ(scores.measures[1].name, "sted");
    EXPECT_EQ(*scores.measures[1].values[0], 0.002);
}

TEST(Scores, AreTheSameWithTabsSemicolonsDecimalCommasQuotesBlanksAndByteOrderMarks)
{
    for (const char* text : {"stimulus\tMOS\tkg\na\t1.5\t0.25\n", "stimulus;MOS;kg\na;1,5;0,25",
                             "\xef\xbb\xbfstimulus,MOS,kg\r\na,1.5,.25\r\n",
                             "\n\n \"stimulus\" , MOS ,\"kg\"\n\n \"a\" , +1.5 , 25e-2 \n\n",
                             "file,mos,kg\na,1.5,0.25\n", "version,Score,kg\na,1.5,0.25\n"}) {
        const auto scores = scores_of(text);
        ASSERT_TRUE(scores.ok()) << text << scores.error().sentence();
        EXPECT_EQ(scores->stimuli[0].name, "a") << text;
        EXPECT_EQ(scores->stimuli[0].mos, 1.5) << text;
        EXPECT_EQ(*scores->measures.at(0).values[0], 0.25) << text;
    }
}

TEST(Scores, MayHaveQuotedNamesOfAnyKind)
{
    const auto scores = *scores_of("stimulus,MOS,kg\n\"one, \"\"two\"\"\nthree\",1,2\n#4,2,3\n");
    EXPECT_EQ(scores.stimuli[0].name, "one, \"two\"\nthree");
    EXPECT_EQ(scores.stimuli[1].name, "#4");
}

TEST(Scores, MayLackNamesDatasetsAndValues)
{
    const auto scores = *scores_of("MOS,kg,sted\n1,,3\n2,4,\n");
    EXPECT_EQ(scores.datasets, std::vector<std::string>{""});
    EXPECT_EQ(scores.measures.size(), 2u);
    EXPECT_FALSE(scores.measures[0].values[0].has_value());
    EXPECT_FALSE(scores.measures[1].values[1].has_value());
}

TEST(Scores, AreReadFromTheColumnsAskedFor)
{
    const auto scores = *scores_of("a,b,c,d,note\nx,1,2,3,fine\ny,4,5,6,bad\n", {"c", "", "a", {"d"}});
    EXPECT_EQ(scores.mos_name, "c");
    EXPECT_EQ(scores.stimuli[1].name, "y");
    ASSERT_EQ(scores.measures.size(), 1u);
    EXPECT_EQ(*scores.measures[0].values[1], 6.0);
}

TEST(Scores, OfAWrongTableNameLineAndColumn)
{
    EXPECT_EQ(problem(""), "line 1: there is no header");
    EXPECT_EQ(problem("MOS,kg\n"), "line 1: there is no row under the header");
    EXPECT_EQ(problem("MOS,,kg\n1,2,3\n"), "line 1: column 2: it has no name");
    EXPECT_EQ(problem("MOS,kg,kg\n1,2,3\n"), "line 1: column 3: another one is 'kg' too");
    EXPECT_EQ(problem("a,kg\nx,3\n"), "line 1: there is no column 'MOS' of mean opinion scores");
    EXPECT_EQ(problem("a,MOS\nx,3\n"), "line 1: there is no column of a measure");
    EXPECT_EQ(problem("MOS,kg\n1,2\n3\n"), "line 3: cells: 1, but the header has 2");
    EXPECT_EQ(problem("MOS,kg\n1,2\n3,4x\n"), "line 3: column 'kg': '4x' is not a finite number");
    EXPECT_EQ(problem("name,MOS,kg\na,1,nan\n"), "line 2: column 'kg': 'nan' is not a finite number");
    EXPECT_EQ(problem("name,MOS,kg\na,1,1e999\n"), "line 2: column 'kg': '1e999' is not a finite number");
    EXPECT_EQ(problem("MOS,kg\n,2\n"), "line 2: column 'MOS': a stimulus without a score");
    EXPECT_EQ(problem("name,MOS,kg\na,1,2\na,3,4\n"), "line 3: column 'name': 'a' is in line 2 already");
    EXPECT_EQ(problem("group,MOS,kg\n,1,2\n"), "line 2: column 'group': a stimulus without a dataset");
    EXPECT_EQ(problem("name,MOS,kg\n\"a,1,2\n"), "line 2: column 1: a quote that does not end");
    EXPECT_EQ(problem("name,MOS,kg\n\"a\"b,1,2\n"), "line 2: column 1: more text after the quote that ends a cell");
    EXPECT_EQ(problem("name,MOS,kg\na\"b,1,2\n"),
              "line 2: column 1: a quote inside a cell that does not begin with one");
    EXPECT_EQ(problem("MOS,kg\n1,\x01\n"), "line 2: column 2: a control character");
    EXPECT_EQ(problem("MOS,kg\n1,2\n", {"mean", "", "", {}}), "there is no column 'mean'");
}

TEST(Scores, OfATableCutAnywhereButBehindACellOfItsLastColumnAreAnError)
{
    const std::string text = "dataset;stimulus;MOS;kg\nwalk;\"a\";1;\"2\"\nwalk;\"b\";3;\"4\"\n";
    for (std::size_t length = 0; length < text.size(); ++length) {
        const std::string cut = text.substr(0, length);
        const bool complete = cut.ends_with("\"2\"") || cut.ends_with("\"2\"\n") || cut.ends_with("\"4\"") ||
                              cut.ends_with("1;") || cut.ends_with("3;"); // ... or an empty cell of it
        EXPECT_EQ(scores_of(cut).ok(), complete) << cut;
    }
}

TEST(Scores, ThatDoNotFitTheLimitsAreRefusedBeforeTheyAreRead)
{
    const std::string text = "MOS,kg\n" + std::string(100000, ',');
    DecodeLimits limits;
    limits.max_memory = 1 << 20;
    const auto csv = io::parse_csv({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, limits);
    ASSERT_FALSE(csv.ok());
    EXPECT_EQ(csv.error().message, "the table does not fit in the memory limit");
}
