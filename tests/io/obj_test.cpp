/// OBJ files: what is read, what is refused, and that writing loses nothing.
// SPDX-License-Identifier: MIT
#include "meshreel/io/attributes.h"
#include "meshreel/io/obj.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

Result<Animation> parsed_obj(std::string_view text, const LoadOptions& options = {})
{
    return parse_obj(bytes_of(text), options);
}

constexpr std::string_view square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

} // namespace

TEST(Obj, PolygonsBecomeFansFromTheirFirstCornerAndThatIsTold)
{
    Listener listener;
    const auto mesh = parsed_obj(std::string(square) + "f 2 3 4 1\n", listener.options);
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{1, 2, 3}, {1, 3, 0}}));
    EXPECT_TRUE(listener.has("1 polygons"));
}

TEST(Obj, NegativeIndicesCountBackFromTheLastVertex)
{
    const auto mesh = parsed_obj("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{1, 2, 3}}));
}

TEST(Obj, LineEndsCommentsTabsAndContinuedLinesAreUnderstood)
{
    const auto mesh = parsed_obj("# a mesh\r\nv\t0 0 0 # first\rv 1 0 0\nv 1 \\\r\n 1 \\\n0\n\n f 1 2\\\n 3");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(mesh->positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0}));
    EXPECT_EQ(mesh->triangles.size(), 1u);
}

TEST(Obj, NumbersAreRoundedOnceToTheNearestFloat)
{
    const auto mesh =
        parsed_obj("v 1.00000017881393432617187499 1e-60 -1e-60\nv +1.5 .5 5.\nv 1e-45 3.4028235e38 -0\n");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    const float tiny = 1.40129846e-45f;
    EXPECT_TRUE(same_bits(mesh->positions, {1.00000012f, 0.0f, -0.0f, 1.5f, 0.5f, 5.0f, tiny, 3.4028235e38f, -0.0f}));
}

TEST(Obj, SeamsKeepTheirOwnIndices)
{
    const auto mesh = parsed_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.1 0.2\nvt 0.3 0.4\nvn 0 0 1\nf 1/2/1 2//1 3/1\n");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(mesh->appearance.find("uv0")->indices, (std::vector<std::uint32_t>{1, no_value, 0}));
    EXPECT_EQ(mesh->appearance.find("normal")->indices, (std::vector<std::uint32_t>{0, 0, no_value}));
    EXPECT_EQ(attribute_float(*mesh->appearance.find("uv0"), 1, 0), 0.3f);
}

TEST(Obj, MaterialsAndGroupsBelongToTriangles)
{
    const auto mesh =
        parsed_obj(std::string(square) + "f 1 2 3\nusemtl red\ng left arm\nf 1 2 4\nusemtl blue\nf 2 3 4\n");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(mesh->appearance.materials, (std::vector<std::string>{"red", "blue"}));
    EXPECT_EQ(mesh->appearance.groups, (std::vector<std::string>{"left arm"}));
    EXPECT_EQ(triangle_number(*mesh->appearance.find("material"), 0), no_value);
    EXPECT_EQ(triangle_number(*mesh->appearance.find("material"), 2), 1u);
    EXPECT_EQ(triangle_number(*mesh->appearance.find("group"), 1), 0u);
}

TEST(Obj, LinesAndPointsAndUnknownStatementsAreTold)
{
    Listener listener;
    const auto mesh = parsed_obj(std::string(square) + "l 1 2\np 3\nwhatever 7\nf 1 2 3\n", listener.options);
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_TRUE(listener.has("lines are left out"));
    EXPECT_TRUE(listener.has("points are left out"));
    EXPECT_TRUE(listener.has("'whatever' in line 7"));
}

TEST(Obj, ANameNeverSwallowsTheNextLine)
{
    const auto mesh = parsed_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\ng a \\\nb\nusemtl c\nf 1 2 3\n");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(mesh->appearance.groups, (std::vector<std::string>{"a"}));
    Animation made = *mesh;
    made.appearance.groups = {"back\\"};
    made.appearance.materials = {"two\nlines"};
    const auto again = parsed_obj(text_of(*write_obj(made, 0, {})));
    ASSERT_TRUE(again.ok()) << why(again);
    EXPECT_EQ(again->appearance.groups, (std::vector<std::string>{"back_"}));
    EXPECT_EQ(again->appearance.materials, (std::vector<std::string>{"two_lines"}));
}

TEST(Obj, WritingAndReadingGivesTheSameBits)
{
    const std::string text = "mtllib a.mtl\nv 0.1 0.2 1e-30 0.5 0.25 1\nv 1 0 0 1 0 0\nv 1 1 0 0 0 0.1\nv 0 1 0 1 1 1\n"
                             "vt 0.1 0.7\nvt 0.3 0.9\nvn 0 0.6 0.8\ng a\nusemtl m\ns 3\nf 1/2/1 2/1/1 3/1/1\n"
                             "g b\ns 0\nf 1//1 3//1 4//1\n";
    const auto mesh = parsed_obj(text);
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    const auto written = write_obj(*mesh, 0, {});
    EXPECT_EQ(text_of(*written).find("s 3"), text.find("s 3"));
    const auto again = parsed_obj(text_of(*written));
    ASSERT_TRUE(again.ok()) << why(again);
    EXPECT_TRUE(same_bits(again->positions, mesh->positions));
    EXPECT_EQ(again->triangles, mesh->triangles);
    ASSERT_EQ(again->appearance.attributes.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(again->appearance.attributes[i].name, mesh->appearance.attributes[i].name);
        EXPECT_EQ(again->appearance.attributes[i].values, mesh->appearance.attributes[i].values);
        EXPECT_EQ(again->appearance.attributes[i].indices, mesh->appearance.attributes[i].indices);
    }
}

TEST(Obj, TheMaterialLibraryTravelsAlong)
{
    const Folder folder;
    write(folder / "a.mtl", "newmtl m\nKd 1 0 0\n");
    write(folder / "a.obj", "mtllib a.mtl\n" + std::string(square) + "usemtl m\nf 1 2 3\n");
    const auto mesh = load(folder / "a.obj");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    std::filesystem::create_directory(folder.path / "out");
    ASSERT_TRUE(save(*mesh, folder / "out/b.obj").ok());
    EXPECT_EQ(read(folder / "out/a.mtl"), "newmtl m\nKd 1 0 0\n");
    EXPECT_TRUE(read(folder / "out/b.obj").starts_with("mtllib a.mtl\n"));
}

TEST(Obj, AMaterialLibraryOutsideTheFolderIsNotRead)
{
    const Folder folder;
    write(folder / "secret", "do not carry me\n");
    std::filesystem::create_directory(folder.path / "in");
    write(folder / "in/a.obj",
          "mtllib ../secret\nmtllib " + (folder / "secret") + "\n" + std::string(square) + "f 1 2 3\n");
    Listener listener;
    const auto mesh = load(folder / "in/a.obj", listener.options);
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    for (const Asset& asset : mesh->appearance.assets) EXPECT_TRUE(asset.bytes.empty());
    EXPECT_TRUE(listener.has("carried by name only"));
}

TEST(Obj, EveryKindOfWrongLineIsNamedByItsNumber)
{
    const std::string s(square);
    EXPECT_EQ(why(parsed_obj(s + "f 1 2 5\n")), "line 5: f: index 5 is beyond the 4 'v' lines");
    EXPECT_EQ(why(parsed_obj(s + "f 1 2 0\n")), "line 5: f: index 0 where 4 'v' lines came before");
    EXPECT_EQ(why(parsed_obj(s + "f 1 2 -5\n")), "line 5: f: index -5 where 4 'v' lines came before");
    EXPECT_EQ(why(parsed_obj(s + "f 1/1 2/1 3/1\n")), "line 5: f: index 1 is beyond the 0 'vt' lines");
    EXPECT_EQ(why(parsed_obj(s + "f 1 2 x\n")), "line 5: f: 'x' is not an index");
    EXPECT_EQ(why(parsed_obj("v 1 2\n")).substr(0, 12), "line 1: v: 2");
    EXPECT_EQ(why(parsed_obj("v 1 2 3,5\n")), "line 1: v: '3,5' is not a number");
    EXPECT_EQ(why(parsed_obj("vt 1 2 3 4\n")), "line 1: vt: 4 numbers instead of 1 to 3");
    EXPECT_EQ(why(parsed_obj(std::string("\x01\x02\0\0", 4))), "line 1: '\?\?\?\?' is no statement of an OBJ file");
    EXPECT_EQ(why(parsed_obj("")), "v: there is no vertex; is this an OBJ file?");
    EXPECT_EQ(why(parsed_obj(s + "f 99999999999999999999 1 2\n")), "line 5: f: '99999999999999999999' is not an index");
}

TEST(Obj, CountsAboveTheLimitsAreRefused)
{
    LoadOptions options;
    options.limits.max_vertices = 3;
    EXPECT_EQ(why(parsed_obj(square, options)), "v: 4 is above the limit of 3");
}
