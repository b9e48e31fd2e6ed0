/// The page of a heat map as a browser shows it.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;

class HeatPage : public CommandTest {
protected:
    /// The page as Chromium leaves it, its data taken out by its own script.
    std::string shown(const std::string& file) const
    {
        const std::string command =
            "cd '" + folder_.string() +
            "' && timeout 120 chromium --headless --no-sandbox --use-angle=swiftshader "
            "--enable-unsafe-swiftshader --hide-scrollbars --window-size=800,600 "
            "--virtual-time-budget=3000 --screenshot=page.png --user-data-dir=profile 'file://" +
            (folder_ / file).string() + "' >log 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << read("log");
        return read("page.png");
    }
};

TEST_F(HeatPage, ShowsTheMeshInABrowser)
{
    if (std::system("command -v chromium >/dev/null 2>&1") != 0) GTEST_SKIP() << "no chromium";
    good("generate jelly a.mdd --mesh a.obj --vertices 600 --frames 6");
    good("generate jelly b.mdd --vertices 600 --frames 6 --seed 2");
    good("compare a.mdd b.mdd --mesh a.obj --heatmap page.html -q");
    const std::string mesh = shown("page.html");
    std::string page = read("page.html");
    const std::size_t draw = page.find("gl.drawElements(");
    ASSERT_NE(draw, page.npos);
    page.replace(draw, 16, "void (0,");
    write("empty.html", page);
    const std::string empty = shown("empty.html");
    ASSERT_GT(empty.size(), 5000u) << "the page without its mesh still has its curve and its words";
    EXPECT_GT(mesh.size(), empty.size() + 5000u) << "a mesh of many colours takes more of a PNG than none";
}
