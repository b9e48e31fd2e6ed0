/// The pictures of compare: what is in the files, and what is refused.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <gmock/gmock.h>

#include "meshreel/io/io.h"
#include "tests/cli/command.h"

using meshreel::cli_test::CommandTest;
using meshreel::cli_test::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

/// A big-endian number of a PNG's header.
unsigned png_number(const std::string& png, std::size_t at)
{
    unsigned number = 0;
    for (std::size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(png.at(i));
    return number;
}

/// The JSON of a GLB.
nlohmann::json glb_json(const std::string& glb)
{
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    return nlohmann::json::parse(glb.substr(20, length));
}

/// The JSON that a page begins with.
nlohmann::json page_json(const std::string& page)
{
    const std::string tag = "<script id=\"meta\" type=\"application/json\">";
    const std::size_t begin = page.find(tag) + tag.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// How many letters of base 64 an element of the page holds.
std::size_t letters_in(const std::string& page, const std::string& id)
{
    const std::string tag = "<script id=\"" + id + "\" type=\"text/plain\">";
    const std::size_t begin = page.find(tag);
    return begin == page.npos ? 0 : page.find("</script>", begin) - begin - tag.size();
}

/// Every tag that is opened is closed, in order. Attributes hold no angle bracket.
bool is_balanced(const std::string& xml)
{
    std::vector<std::string> open;
    for (std::size_t at = xml.find('<'); at != xml.npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == xml.npos) return false;
        const std::string tag = xml.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" /", 1) - (tag[0] == '/'));
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != tag) return false;
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(tag.substr(0, tag.find(' ')));
        }
    }
    return open.empty();
}

} // namespace

class ComparedPictures : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        good("generate wave a.mdd --mesh a.obj --vertices 100 --frames 6");
        good("generate wave b.mdd --vertices 100 --frames 6 --seed 2");
    }

    Outcome compare(const std::string& options) const { return run("compare a.mdd b.mdd --mesh a.obj " + options); }
    /// Compares, expects exit code 0, and gives back a file that was written.
    std::string picture(const std::string& options, const std::string& file) const
    {
        const Outcome outcome = compare(options + " " + file);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read(file);
    }
    meshreel::Animation load(const std::string& file) const
    {
        meshreel::io::LoadOptions options;
        options.mesh = (folder_ / "a.obj").string();
        return *meshreel::io::load((folder_ / file).string(), options);
    }
};

TEST_F(ComparedPictures, APlyHoldsAColourAndTheErrorOfEachVertex)
{
    picture("--heat-of 3 --heatmap", "heat.ply");
    const meshreel::Animation a = load("a.mdd"), b = load("b.mdd"), heat = load("heat.ply");
    const meshreel::Attribute* quality = heat.appearance.find("quality");
    ASSERT_NE(quality, nullptr);
    ASSERT_NE(heat.appearance.find("color0"), nullptr);
    EXPECT_EQ(heat.triangles, b.triangles);
    for (std::size_t v = 0; v < a.vertex_count; ++v) {
        double square = 0.0;
        for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
            EXPECT_EQ(heat.positions[i], b.frame(3)[i]);
            square += std::pow(static_cast<double>(a.frame(3)[i]) - b.frame(3)[i], 2.0);
        }
        float error = 0.0f;
        std::memcpy(&error, quality->values.data() + 4 * v, 4);
        EXPECT_FLOAT_EQ(error, static_cast<float>(std::sqrt(square)));
    }
}

TEST_F(ComparedPictures, TheLargestErrorOfAHeatMapIsTheOneThatIsMeasured)
{
    const double largest = compare("--metric max_error --heatmap heat.ply --json").json()["metrics"]["max_error"];
    const meshreel::Animation heat = load("heat.ply");
    const meshreel::Attribute* quality = heat.appearance.find("quality");
    std::vector<float> errors(quality->value_count());
    std::memcpy(errors.data(), quality->values.data(), quality->values.size());
    EXPECT_FLOAT_EQ(*std::max_element(errors.begin(), errors.end()), static_cast<float>(largest));
}

TEST_F(ComparedPictures, AGlbPlaysTheDistortedAnimationBesideItsColourBar)
{
    const nlohmann::json root = glb_json(picture("--heat-top 2 --heatmap", "heat.glb"));
    const nlohmann::json& mesh = root["meshes"][0]["primitives"][0];
    EXPECT_EQ(mesh["targets"].size(), 5u);
    EXPECT_TRUE(mesh["attributes"].contains("COLOR_0"));
    EXPECT_TRUE(mesh["attributes"].contains("_ERROR"));
    EXPECT_EQ(root["nodes"][1]["name"], "colour bar");
    const nlohmann::json& told = root["scenes"][0]["extras"]["meshreel"];
    EXPECT_EQ(told["range"], nlohmann::json({0.0, 2.0}));
    EXPECT_EQ(told["unit"], "units");
    EXPECT_EQ(load("heat.glb").frame_count(), 6u);
}

TEST_F(ComparedPictures, KhronosValidatorFindsNoErrorInAGlb)
{
    const std::string io = std::string(MESHREEL_SOURCE_DIR) + "/tests/io";
    if (std::system(("cd '" + io + "' && node -e 'require(\"gltf-validator\")' >/dev/null 2>&1").c_str()) != 0)
        GTEST_SKIP() << "no node with gltf-validator";
    picture("--heatmap", "moving.glb");
    picture("--frames 2 --heat sted --up z --heatmap", "still.glb");
    const std::string folder = folder_.string();
    EXPECT_EQ(std::system(("cd '" + folder + "' && node '" + io + "/gltf_validator.mjs' *.glb >log 2>&1").c_str()), 0)
        << read("log");
}

TEST_F(ComparedPictures, APageHoldsEveryFrameAndAsksForNothingElse)
{
    const std::string page = picture("--heatmap", "heat.html");
    const nlohmann::json meta = page_json(page);
    const std::size_t V = meta["V"];
    EXPECT_EQ(meta["frames"].size(), 6u);
    EXPECT_EQ(letters_in(page, "errors"), (6 * V + 2) / 3 * 4);
    EXPECT_EQ(letters_in(page, "positions"), (6 * V * 6 + 2) / 3 * 4);
    EXPECT_EQ(letters_in(page, "others"), letters_in(page, "positions"));
    for (const char* outside : {"http:", "https:", " src=", "import ", "fetch("})
        EXPECT_THAT(page, Not(HasSubstr(outside)));
}

TEST_F(ComparedPictures, APageThatWouldBeTooLargeLeavesOutFramesAndSaysSo)
{
    const std::string whole = picture("--heatmap", "whole.html");
    const std::string page = picture("--heat-size 40000 --heatmap", "part.html");
    const nlohmann::json meta = page_json(page);
    EXPECT_LE(page.size(), 40000u);
    EXPECT_LT(page.size(), whole.size());
    EXPECT_LT(meta["frames"].size(), 6u);
    EXPECT_EQ(meta["tops"].size(), 6u);
    EXPECT_THAT(meta["note"].get<std::string>(), HasSubstr("of 6 frames"));
}

TEST_F(ComparedPictures, CurvesAreOneOfEachMeasureThatHasValuesOfFrames)
{
    const std::string svg = picture("--metric kg,sted --curves", "curves.svg");
    EXPECT_TRUE(is_balanced(svg));
    EXPECT_THAT(svg, HasSubstr("STED"));
    EXPECT_THAT(svg, HasSubstr("b.mdd against a.mdd"));
    EXPECT_THAT(svg, HasSubstr("prefers-color-scheme:dark"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST_F(ComparedPictures, AStripHasAColumnForEveryView)
{
    const std::string four = picture("--strip", "four.png"), six = picture("--strip-views 6 --strip", "six.png");
    EXPECT_EQ(four.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(png_number(six, 16) - png_number(four, 16), 2 * 310u);
    EXPECT_GT(png_number(four, 20), 400u);
}

TEST_F(ComparedPictures, EqualAnimationsAreDrawnWithoutAnErrorAndWithoutNaN)
{
    good("compare a.mdd a.mdd --mesh a.obj --heatmap a.html --curves a.svg --strip a.png");
    const nlohmann::json meta = page_json(read("a.html"));
    EXPECT_EQ(meta["top"], 1.0);
    EXPECT_THAT(meta["tops"], testing::Each(0.0));
    EXPECT_THAT(read("a.svg"), Not(HasSubstr("nan")));
}

TEST_F(ComparedPictures, OneFrameIsDrawnToo)
{
    good("compare a.mdd b.mdd --mesh a.obj --frames 2 --heatmap a.html --curves a.svg --strip a.png --strip-frame "
         "spread");
    good("compare a.mdd b.mdd --mesh a.obj --frames 2 --heatmap a.glb");
    EXPECT_FALSE(glb_json(read("a.glb")).contains("animations"));
    EXPECT_THAT(read("a.svg"), Not(HasSubstr("nan")));
}

TEST_F(ComparedPictures, PointsWithoutTrianglesAreDrawnAsPoints)
{
    write("p.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
    write("q.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\n");
    good("compare p.obj q.obj --heatmap a.glb --strip a.png --metric vertex_error");
    good("compare p.obj q.obj --heatmap a.html --metric vertex_error");
    EXPECT_EQ(glb_json(read("a.glb"))["meshes"][0]["primitives"][0]["mode"], 0);
    EXPECT_EQ(page_json(read("a.html"))["T"], 0);
}

TEST_F(ComparedPictures, NothingIsOverwrittenWithoutYesAndNothingMeasuredBefore)
{
    write("old.png", "mine");
    const Outcome refused = compare("--strip old.png");
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_EQ(read("old.png"), "mine");
    EXPECT_EQ(compare("--strip old.png --skip-existing").exit_code, 0);
    EXPECT_EQ(read("old.png"), "mine");
    EXPECT_EQ(compare("--strip old.png -y").exit_code, 0);
    EXPECT_NE(read("old.png"), "mine");
}

TEST_F(ComparedPictures, AFrameThatIsNotThereIsRefusedBeforeAnythingIsWritten)
{
    const Outcome refused = compare("--heatmap heat.ply --heat-of 6 --curves a.svg");
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("no frame 6"));
    EXPECT_THAT(files(), ElementsAre("a.mdd", "a.obj", "b.mdd"));
}
