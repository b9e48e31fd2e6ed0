/// OFF files and their kin.
// SPDX-License-Identifier: MIT
#include "meshreel/io/attributes.h"
#include "meshreel/io/off.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

Result<Animation> parsed_off(std::string_view text, const LoadOptions& options = {})
{
    return parse_off(bytes_of(text), options);
}

const std::string corners = "3 1 0\n0 0 0\n1 0 0\n1 1 0\n";

} // namespace

TEST(Off, TheFirstWordCommentsAndBlankLinesMayBeMissingOrThere)
{
    for (const std::string& text :
         {"OFF\n" + corners, "OFF " + corners, corners, "# made\n\nOFF # it is\n\n" + corners}) {
        const auto read = parsed_off(text + "3 0 1 2\n");
        ASSERT_TRUE(read.ok()) << why(read);
        EXPECT_EQ(read->triangles, (std::vector<Triangle>{{0, 1, 2}}));
    }
}

TEST(Off, TheKinCarryColoursNormalsAndTextureCoordinates)
{
    const auto read =
        parsed_off("STCNOFF\n3 0 0\n0 0 0 0 0 1 255 0 9 0.5 0.25\n1 0 0 0 1 0 1 2 3 0.125 1\n1 1 0 1 0 0 4 5 6 0 0\n");
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->appearance.find("color0")->values, (Bytes{255, 0, 9, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(attribute_float(*read->appearance.find("normal"), 2, 0), 1.0f);
    EXPECT_EQ(attribute_float(*read->appearance.find("uv0"), 1, 0), 0.125f);
}

TEST(Off, ColoursOfFacesBelongToTheirTriangles)
{
    Listener listener;
    const auto read =
        parsed_off("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 1 0.5 0\n3 0 1 2\n3 0 1 2 5\n", listener.options);
    ASSERT_TRUE(read.ok()) << why(read);
    const Attribute* color = read->appearance.find("face_color");
    EXPECT_EQ(color->indices, (std::vector<std::uint32_t>{0, 0, no_value, no_value}));
    EXPECT_EQ(attribute_float(*color, 0, 1), 0.5f);
    EXPECT_TRUE(listener.has("1 polygons"));
    EXPECT_TRUE(listener.has("colour map"));
}

TEST(Off, WritingAndReadingGivesTheSameBits)
{
    Animation made = tetrahedron(1);
    auto& attributes = made.appearance.attributes;
    attributes.push_back(float_attribute("normal", Domain::vertex, 3, made.positions));
    attributes.push_back({"color0", Domain::vertex, Scalar::u8, 4, true, Bytes(16, 77), {}});
    attributes.push_back(float_attribute("uv0", Domain::vertex, 2, std::span(made.positions).first(8)));
    attributes.push_back(indexed(float_attribute("face_color", Domain::triangle, 3,
                                                 std::vector<float>{1, std::numeric_limits<float>::infinity(), 0}),
                                 {0, 0, no_value, 0}));
    const auto read = parsed_off(text_of(*write_off(made, 0, {})));
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_TRUE(same_bits(read->positions, made.positions));
    EXPECT_EQ(read->triangles, made.triangles);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read->appearance.attributes[i].values, attributes[i].values) << i;
    EXPECT_EQ(triangle_number(read->appearance.attributes[3], 2), no_value);
    EXPECT_EQ(attribute_float(read->appearance.attributes[3], 2, 1), std::numeric_limits<float>::infinity());
}

TEST(Off, ErrorsNameTheLineAndField)
{
    EXPECT_EQ(why(parsed_off("")), "line 1: signature: the file is empty");
    EXPECT_EQ(why(parsed_off("ply\n")), "line 1: signature: this is no OFF file: it begins with 'ply'");
    EXPECT_EQ(why(parsed_off("4OFF\n")), "signature: '4OFF' has not three dimensions");
    EXPECT_EQ(why(parsed_off("OFF BINARY\n")), "signature: binary OFF files are not read");
    EXPECT_EQ(why(parsed_off("OFF\n3 x 0\n")), "line 2: face_count: 'x' is not a count");
    EXPECT_EQ(why(parsed_off("OFF\n900000 1 0\n0 0 0\n")),
              "line 2: vertex_count: 900000 vertices are promised, but 7 bytes are left");
    EXPECT_EQ(why(parsed_off("OFF\n" + corners + "3 0 1 3\n")), "line 6: face: '3' is not one of the 3 vertices");
    EXPECT_EQ(why(parsed_off("OFF\n" + corners + "3 0 1\n")), "line 6: face: the line ends after 2 of 3 corners");
    EXPECT_EQ(why(parsed_off("OFF\n" + corners)), "line 5: face_count: the file ends after 0 of 1 faces");
    EXPECT_EQ(why(parsed_off("OFF\n" + corners + "99 0 1\n")),
              "line 6: face: a face of 99 corners, but 5 bytes are left");
    EXPECT_EQ(why(parsed_off("OFF\n3 0 0\n0 0 0\n1 0\n1 1 0\n")), "line 4: position: the line ends too early");
}

TEST(Off, EveryTruncationAndFlippedBitGivesAnErrorOrAMeshThatFits)
{
    const Bytes good = *write_off(tetrahedron(1), 0, {});
    for (std::size_t size = 0; size + 5 < good.size(); ++size)
        EXPECT_FALSE(parse_off(ByteView(good).first(size), {}).ok()) << size;
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        Bytes bad = good;
        bad[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        const auto read = parse_off(bad, {});
        EXPECT_TRUE(!read.ok() || validate(*read).ok() || validate(*read).error().field == "positions") << bit;
    }
}
