/// The pictures of the command: what is drawn, and what is refused.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

} // namespace

class Pictures : public CommandTest {};

TEST_F(Pictures, EveryColumnHasThreePanelsAndATime)
{
    good("generate jelly a.mdd --mesh a.obj --vertices 98 --frames 9");
    good("picture a.mdd a.mdd a.svg --mesh a.obj --columns 3 --title jelly");
    const std::string svg = read("a.svg");
    EXPECT_EQ(count(svg, "data:image/png;base64,iVBORw0KGgo"), 9u);
    EXPECT_EQ(count(svg, ">frame "), 3u);
    EXPECT_THAT(svg, HasSubstr(">jelly</text>"));
    EXPECT_THAT(svg, HasSubstr("largest of all 9 frames: 0 %"));
}

TEST_F(Pictures, TheScaleReachesTheLargestError)
{
    good("generate wave a.mdd --mesh a.obj --vertices 100 --frames 5");
    good("generate wave b.mdd --vertices 100 --frames 5 --seed 2");
    const double largest = good("compare a.mdd b.mdd --mesh a.obj --json").json()["metrics"]["max_error_relative"];
    good("picture a.mdd b.mdd a.svg --mesh a.obj");
    std::string text(64, '\0');
    text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "frames: %.3g %%", largest)));
    EXPECT_THAT(read("a.svg"), HasSubstr(text));
}

TEST_F(Pictures, AnimationsThatCannotBeComparedAreNotDrawn)
{
    good("generate wave a.mdd --mesh a.obj --vertices 100 --frames 5");
    good("generate wave b.mdd --vertices 100 --frames 6");
    EXPECT_EQ(run("picture a.mdd b.mdd a.svg --mesh a.obj").exit_code, 3);
    EXPECT_THAT(files(), ElementsAre("a.mdd", "a.obj", "b.mdd"));
}
