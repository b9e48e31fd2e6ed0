/// distort: amounts, units, and what is refused.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "meshreel/distort/distortion.h"
#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

class DistortCommand : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        good("generate cloth a.pc2 --mesh a.obj --vertices 100 --frames 6");
    }
    Outcome distort(const std::string& words) const { return run("distort a.pc2 --mesh a.obj " + words); }
};

TEST_F(DistortCommand, KnowsEveryKindAndListsIt)
{
    const std::string help = good("distort --help").out;
    for (const meshreel::distort::Distortion& row : meshreel::distort::all()) {
        EXPECT_THAT(help, HasSubstr("  " + std::string(row.name) + " "));
        const std::string amount = row.unit == meshreel::distort::Unit::count   ? "3"
                                   : row.unit == meshreel::distort::Unit::share ? "50%"
                                                                                : "1%";
        const Outcome outcome = distort("b.glb " + std::string(row.name) + " --amount " + amount + " -y");
        EXPECT_EQ(outcome.exit_code, 0) << row.name << ": " << outcome.err;
    }
}

TEST_F(DistortCommand, TakesPercentOfTheBodyDiagonalOrModelUnits)
{
    const auto percent = distort("b.pc2 noise-vertex --amount 2% --json").json();
    EXPECT_EQ(percent["unit"], "model units");
    const std::string units = std::to_string(percent["amount"].get<double>());
    EXPECT_NEAR(distort("c.pc2 noise-vertex --amount " + units + " --json").json()["amount"].get<double>(),
                percent["amount"].get<double>(), 1e-6);
    EXPECT_EQ(distort("d.pc2 noise-vertex --amount 2% --seed 2").exit_code, 0);
    EXPECT_NE(read("b.pc2"), read("d.pc2"));
}

TEST_F(DistortCommand, SimplifiesToItsShare)
{
    EXPECT_EQ(distort("b.glb simplify --amount 25% --json").json()["vertices"], 25);
}

TEST_F(DistortCommand, RefusesWhatMakesNoSenseAndLeavesNoFile)
{
    for (const char* words :
         {"b.pc2 nose --amount 1%", "b.pc2 noise-vertex", "b.pc2 noise-vertex --amount -1", "b.pc2 smooth --amount 5%",
          "b.pc2 smooth --amount 1.5", "b.pc2 simplify --amount 2", "b.pc2 smooth --amount 2 --omega 3",
          "b.pc2 noise-vertex --amount 1e300", "a.pc2 smooth --amount 2 -y"})
        EXPECT_EQ(distort(words).exit_code, 1) << words;
    EXPECT_FALSE(exists("b.pc2"));
    EXPECT_THAT(distort("b.pc2 smoth --amount 1").err, HasSubstr("did you mean 'smooth'?"));
}
