/// play and export: what goes into a page, and what is refused. js/test/play.test.mjs looks at them in a browser.
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::HasSubstr;

class Page : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        good("generate wave a.pc2 --mesh a.obj --vertices 60 --frames 4");
        good("encode a.pc2 --mesh a.obj a.reel");
        write("page.html", "<p>before</p>" + room_ + "<p>after</p>");
    }

    const std::string room_ = R"(<script type="application/json" id="manifest">null</script>)";
};

TEST_F(Page, OfExportHasTheFileInItAndAllElseAsItWas)
{
    good("export --html out.html a.reel --page page.html");
    const std::string page = read("out.html");
    EXPECT_THAT(page, testing::StartsWith("<p>before</p><script type=\"application/json\" id=\"manifest\">{"));
    EXPECT_THAT(page, testing::EndsWith("</script><p>after</p>"));
    EXPECT_THAT(page, HasSubstr("<script type=\"text/plain\" id=\"item-0\">jVJFRUwN")) << "base 64 of the signature";
}

TEST_F(Page, OfExportIsMadeOfAnyAnimation)
{
    good("export --html reel.html a.reel --page page.html");
    const auto figures = good("export --html out.html a.pc2 --mesh a.obj --page page.html --json").json();
    EXPECT_EQ(figures["reel_bytes"], read("a.reel").size()) << "encoded as encode does by default";
}

TEST_F(Page, ATitleCannotEndTheScriptThatItStandsIn)
{
    good("export --html out.html a.reel --page page.html --title </script>");
    EXPECT_THAT(read("out.html"), HasSubstr(R"("name":"\u003c/script>")"));
}

TEST_F(Page, IsNotWrittenOverAFileUnlessToldTo)
{
    good("export --html out.html a.reel --page page.html");
    EXPECT_EQ(run("export --html out.html a.reel --page page.html").exit_code, 1);
    EXPECT_TRUE(good("export --html out.html a.reel --page page.html --skip-existing --json").json()["skipped"]);
    good("export --html out.html a.reel --page page.html -y");
}

TEST_F(Page, OfABrokenFileOrWithoutRoomIsNotWritten)
{
    std::string reel = read("a.reel");
    reel[reel.size() / 2] ^= 4;
    write("broken.reel", reel);
    write("other.html", "<p>no room</p>");
    EXPECT_EQ(run("export --html out.html broken.reel --page page.html").exit_code, 3);
    EXPECT_EQ(run("export --html out.html a.reel --page other.html").exit_code, 3);
    EXPECT_EQ(run("export --html out.html a.reel --page none.html").exit_code, 2);
    EXPECT_FALSE(exists("out.html"));
}

TEST_F(Page, OfPlayNeedsFilesThatAreThere)
{
    EXPECT_EQ(run("play none.reel --no-open --page page.html").exit_code, 2);
    EXPECT_EQ(run("play a.reel --against none.obj --no-open --page page.html").exit_code, 2);
    EXPECT_EQ(run("play a.reel --port 0 --no-open --page page.html").exit_code, 1);
}
