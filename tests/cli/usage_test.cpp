/// The command line itself: help, version, mistakes and hints.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

class Usage : public CommandTest {
protected:
    /// Verbs as the help lists them.
    std::vector<std::string> verbs() const
    {
        std::istringstream help(good("--help").out);
        std::vector<std::string> names;
        bool inside = false;
        for (std::string line; std::getline(help, line) && !(inside && line.empty());) {
            if (inside) names.push_back(line.substr(2, line.find(' ', 2) - 2));
            inside = inside || line == "Verbs:";
        }
        return names;
    }
};

TEST_F(Usage, TheVersionIsOneLine)
{
    EXPECT_THAT(good("--version").out, testing::MatchesRegex("meshreel [0-9]+[.][0-9]+[.][0-9]+\n"));
}

TEST_F(Usage, EveryVerbHasHelpWithAnExample)
{
    EXPECT_GE(verbs().size(), 4u);
    for (const std::string& verb : verbs()) {
        EXPECT_THAT(good(verb + " --help").out, HasSubstr("Examples:\n  meshreel " + verb));
        EXPECT_EQ(good("help " + verb).out, good(verb + " --help").out);
    }
}

TEST_F(Usage, EveryMistakeOnTheCommandLineExitsOneWithOneSentence)
{
    for (const std::string words :
         {"", "fly", "convert", "convert a.obj", "convert a.obj b.obj c.obj", "convert --nothing",
          "generate wave x.pc2 --frames", "generate wave x.pc2 --frames none", "generate wave x.pc2 --fps 0",
          "generate wave x.pc2 --vertices -1", "generate wave x.pc2 --frames 0", "validate a.obj --frames 5:1",
          "validate a.obj --max-memory 4X", "generate wave x.pc2 -y --skip-existing"}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 1) << words;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << words << ": " << outcome.err;
        EXPECT_EQ(outcome.out, "") << words;
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(Usage, ASlipOfThePenGetsAHint)
{
    EXPECT_THAT(run("genrate").err, HasSubstr("did you mean 'generate'?"));
    EXPECT_THAT(run("compare a b --metirc kg").err, HasSubstr("did you mean --metric?"));
    EXPECT_THAT(run("compare a b --metric gk").err, HasSubstr("did you mean 'kg'?"));
    EXPECT_THAT(run("generate wvae out.pc2").err, HasSubstr("did you mean 'wave'?"));
}

TEST_F(Usage, AMistakeIsToldInJsonToo)
{
    const Outcome outcome = run("convert a.obj --json");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.json()["schema"], "meshreel.error/1");
    EXPECT_EQ(outcome.json()["error"]["code"], "usage");
    EXPECT_EQ(outcome.json()["error"]["exit"], 1);
    EXPECT_FALSE(outcome.json()["error"]["message"].empty());
}

TEST_F(Usage, QuietSaysNothingButErrors)
{
    EXPECT_EQ(good("generate wave a.mdd --vertices 50 --frames 2 -q").err, "");
    EXPECT_NE(run("generate wave a.mdd -q").err, "");
}

TEST_F(Usage, VerboseSaysMore)
{
    const std::string usual = good("generate wave a.mdd --vertices 50 --frames 2").err;
    EXPECT_GT(good("generate wave b.mdd --vertices 50 --frames 2 -v").err.size(), usual.size());
}

TEST_F(Usage, NoProgressBarIsDrawnWhereStandardErrorIsNoTerminal)
{
    EXPECT_EQ(good("generate wave a.mdd --vertices 50 --frames 2").err.find('\r'), std::string::npos);
}
