/// PLY files: three codings, properties of any name, and what is refused.
// SPDX-License-Identifier: MIT
#include "meshreel/io/attributes.h"
#include "meshreel/io/ply.h"
#include "tests/io/made.h"

using namespace meshreel;
using namespace meshreel::io;
using namespace meshreel::io::test;

namespace {

Result<Animation> parsed_ply(const Bytes& bytes, const LoadOptions& options = {})
{
    return parse_ply(bytes, options);
}
Result<Animation> parsed_ply(std::string_view text, const LoadOptions& options = {})
{
    return parse_ply(bytes_of(text), options);
}

const std::string triangle_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// A tetrahedron with one attribute of each kind that a PLY file holds.
Animation dressed_ply()
{
    Animation made = tetrahedron(1);
    auto& attributes = made.appearance.attributes;
    attributes.push_back(float_attribute("normal", Domain::vertex, 3, made.positions));
    attributes.push_back(float_attribute("uv0", Domain::vertex, 2, std::span(made.positions).first(8)));
    attributes.push_back({"color0", Domain::vertex, Scalar::u8, 4, true, Bytes(16, 77), {}});
    attributes.push_back({"heat", Domain::vertex, Scalar::i16, 1, false, Bytes(8, 0xf1), {}});
    attributes.push_back(float_attribute("weights", Domain::vertex, 2, std::span(made.positions).last(8)));
    attributes.push_back({"face_color", Domain::triangle, Scalar::u8, 3, true, Bytes(12, 3), {}});
    attributes.push_back(triangle_numbers("material", std::vector<std::uint32_t>{0, 1, 1, 0}));
    made.appearance.materials = {"red paint", "blue"};
    made.appearance.groups = {"all"};
    return made;
}

void expect_same(const Animation& a, const Animation& b)
{
    EXPECT_TRUE(same_bits(a.positions, b.positions));
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.appearance.materials, b.appearance.materials);
    EXPECT_EQ(a.appearance.groups, b.appearance.groups);
    ASSERT_EQ(a.appearance.attributes.size(), b.appearance.attributes.size());
    for (const Attribute& x : a.appearance.attributes) {
        const Attribute* y = b.appearance.find(x.name);
        ASSERT_NE(y, nullptr) << x.name;
        EXPECT_EQ(x.domain, y->domain) << x.name;
        EXPECT_EQ(x.type, y->type) << x.name;
        EXPECT_EQ(x.components, y->components) << x.name;
        EXPECT_EQ(x.normalized, y->normalized) << x.name;
        EXPECT_EQ(x.values, y->values) << x.name;
        EXPECT_EQ(x.indices, y->indices) << x.name;
    }
}

/// The same file in the other byte order, for a header of float x, y, z and a list uchar uint.
Bytes swapped(Bytes bytes)
{
    const std::string text = text_of(bytes);
    const std::size_t body = text.find("end_header\n") + 11;
    std::string head = text.substr(0, body);
    head.replace(head.find("little"), 6, "big");
    for (std::size_t i = 0; i < 12; ++i) std::reverse(bytes.begin() + body + i * 4, bytes.begin() + body + i * 4 + 4);
    for (std::size_t f = 0; f < 4; ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = bytes.begin() + body + 48 + f * 13 + 1 + i * 4;
            std::reverse(at, at + 4);
        }
    Bytes all = bytes_of(head);
    all.insert(all.end(), bytes.begin() + body, bytes.end());
    return all;
}

} // namespace

TEST(Ply, TextAndBinaryGiveBackEveryAttributeBitForBit)
{
    for (const bool binary : {true, false}) {
        SaveOptions options;
        options.binary = binary;
        const auto read = parsed_ply(*write_ply(dressed_ply(), 0, options));
        ASSERT_TRUE(read.ok()) << why(read);
        expect_same(dressed_ply(), *read);
    }
}

TEST(Ply, BigEndianFilesAreRead)
{
    const auto read = parsed_ply(swapped(*write_ply(tetrahedron(1), 0, {})));
    ASSERT_TRUE(read.ok()) << why(read);
    expect_same(tetrahedron(1), *read);
}

TEST(Ply, TextureCoordinatesOfCornersSurvive)
{
    Animation made = tetrahedron(1);
    std::vector<std::uint32_t> indices(12);
    for (std::uint32_t i = 0; i < 12; ++i) indices[i] = i * 5 % 6;
    made.appearance.attributes.push_back(
        indexed(float_attribute("uv0", Domain::corner, 2, std::span(made.positions).first(12)), indices));
    const auto read = parsed_ply(*write_ply(made, 0, {}));
    ASSERT_TRUE(read.ok()) << why(read);
    const Attribute* uvs = read->appearance.find("uv0");
    ASSERT_NE(uvs, nullptr);
    for (std::size_t corner = 0; corner < 12; ++corner)
        EXPECT_EQ(attribute_float(*uvs, corner_value(*uvs, *read, corner), 1), made.positions[indices[corner] * 2 + 1]);
}

TEST(Ply, PolygonsBecomeFansThatShareTheirFacesValues)
{
    Listener listener;
    const auto read = parsed_ply(
        "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty double x\nproperty double y\n"
        "property double z\nelement face 2\nproperty uchar kind\nproperty list uchar int vertex_index\n"
        "element edge 1\nproperty int vertex1\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n7 4 0 1 2 3\n9 3 0 1 2\n0\n",
        listener.options);
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_EQ(read->triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
    const Attribute* kind = read->appearance.find("kind");
    EXPECT_EQ(triangle_number(*kind, 1), 7u);
    EXPECT_EQ(triangle_number(*kind, 2), 9u);
    EXPECT_TRUE(listener.has("1 polygons"));
    EXPECT_TRUE(listener.has("element edge are left out"));
    EXPECT_TRUE(listener.has("positions are rounded"));
}

TEST(Ply, NamesThatWouldMeetAreKeptApart)
{
    Animation made = tetrahedron(1);
    made.appearance.attributes.push_back(float_attribute("x", Domain::vertex, 1, std::span(made.positions).first(4)));
    made.appearance.attributes.push_back(float_attribute("a b", Domain::vertex, 1, std::span(made.positions).first(4)));
    made.appearance.attributes.push_back(float_attribute("a_b", Domain::vertex, 1, std::span(made.positions).last(4)));
    const auto read = parsed_ply(*write_ply(made, 0, {}));
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_TRUE(same_bits(read->positions, made.positions));
    EXPECT_EQ(read->appearance.find("x_")->values, made.appearance.find("x")->values);
    EXPECT_EQ(read->appearance.find("a_b_")->values, made.appearance.find("a_b")->values);
}

TEST(Ply, AttributesThatLookLikePartsOfOneStayApart)
{
    Animation made = tetrahedron(1);
    for (const char* name : {"a_0", "a_1",
                             "gr\xc3\xb6\xc3\x9f"
                             "e"})
        made.appearance.attributes.push_back({name, Domain::vertex, Scalar::u8, 1, false, Bytes(4, 7), {}});
    const auto read = parsed_ply(*write_ply(made, 0, {}));
    ASSERT_TRUE(read.ok()) << why(read);
    ASSERT_EQ(read->appearance.attributes.size(), 3u);
    EXPECT_EQ(read->appearance.attributes[0].name, "a_0");
    EXPECT_EQ(read->appearance.attributes[1].name, "a_1_");
    EXPECT_EQ(read->appearance.attributes[2].name, made.appearance.attributes[2].name);
}

TEST(Ply, PartsStayTogetherWhereANameIsTaken)
{
    Animation made = tetrahedron(1);
    const auto add = [&](const char* name, std::size_t components) {
        const Bytes bytes(4 * components, static_cast<std::uint8_t>(name[0]));
        made.appearance.attributes.push_back(
            {name, Domain::vertex, Scalar::u8, static_cast<std::uint8_t>(components), false, bytes, {}});
    };
    add("s", 1), add("uv0", 2), add("heat_1", 1), add("heat", 2), add("a", 1), add("a ", 2), add("a_", 1);
    const auto read = parsed_ply(*write_ply(made, 0, {}));
    ASSERT_TRUE(read.ok()) << why(read);
    ASSERT_EQ(read->appearance.attributes.size(), 7u);
    for (const char* name : {"s", "uv0", "heat_1", "heat_", "a", "a_", "a__"}) {
        const Attribute* found = read->appearance.find(name);
        ASSERT_NE(found, nullptr) << name;
        EXPECT_EQ(found->values[0], name[0]) << name;
    }
}

TEST(Ply, TrianglesWithoutAMaterialStayWithoutOne)
{
    Animation made = tetrahedron(1);
    made.appearance.materials = {"red"};
    made.appearance.attributes.push_back(
        triangle_numbers("material", std::vector<std::uint32_t>{0, no_value, 0, no_value}));
    for (const bool binary : {true, false}) {
        SaveOptions options;
        options.binary = binary;
        const auto read = parsed_ply(*write_ply(made, 0, options));
        ASSERT_TRUE(read.ok()) << why(read);
        EXPECT_TRUE(validate(*read).ok()) << why(validate(*read));
        EXPECT_EQ(triangle_number(*read->appearance.find("material"), 0), 0u);
        EXPECT_EQ(triangle_number(*read->appearance.find("material"), 3), no_value);
    }
}

TEST(Ply, AForeignPropertyCalledMaterialGoesByAnotherName)
{
    const auto read =
        parsed_ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "property uchar group\nelement face 1\nproperty list uchar int vertex_indices\n"
                   "property int material\nend_header\n0 0 0 1\n1 0 0 2\n1 1 0 3\n3 0 1 2 5\n");
    ASSERT_TRUE(read.ok()) << why(read);
    EXPECT_TRUE(validate(*read).ok()) << why(validate(*read));
    EXPECT_EQ(triangle_number(*read->appearance.find("material_id"), 0), 5u);
    EXPECT_NE(read->appearance.find("group_id"), nullptr);
}

TEST(Ply, EveryTruncationOfABinaryFileIsAnError)
{
    const Bytes good = *write_ply(dressed_ply(), 0, {});
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(parse_ply(ByteView(good).first(size), {}).ok()) << size;
}

TEST(Ply, EveryFlippedBitGivesAnErrorOrAMeshThatFits)
{
    for (const bool binary : {true, false}) {
        SaveOptions options;
        options.binary = binary;
        const Bytes good = *write_ply(dressed_ply(), 0, options);
        for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
            Bytes bad = good;
            bad[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            const auto read = parsed_ply(bad);
            if (!read.ok()) continue;
            const auto valid = validate(*read);
            EXPECT_TRUE(valid.ok() || valid.error().field == "positions") << bit << ' ' << why(valid);
        }
    }
}

TEST(Ply, ErrorsNameLineOrByteAndField)
{
    const std::string h = triangle_header;
    EXPECT_EQ(why(parsed_ply("solid\n")), "line 1: signature: this is no PLY file: its first line is not 'ply'");
    EXPECT_EQ(why(parsed_ply("ply\nformat ascii 2.0\n")), "line 2: format: version '2.0'; 1.0 is known");
    EXPECT_EQ(why(parsed_ply(h + "0.25 0 0\n1 0 0\n1 1\n")), "line 12: z: the file ends before this number");
    EXPECT_EQ(why(parsed_ply(h + "0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n")),
              "line 13: vertex_indices: index 3 of face 0 is not one of the 3 vertices");
    EXPECT_EQ(why(parsed_ply(h + "0 0 0\n1 0 x\n1 1 0\n3 0 1 2\n")),
              "line 11: z: 'x' is no number of the property's type");
    EXPECT_EQ(why(parsed_ply(h + "0 0 0\n1 0 0\n1 1 0\n300 0 1 2\n")),
              "line 13: vertex_indices: '300' is no number of the property's type");
    EXPECT_EQ(why(parsed_ply(h + "0 0 0\n1 0 0\n1 1 0\n200 0 1 2\n")),
              "line 13: vertex_indices: a list of 200 numbers, but 7 bytes are left");
    std::string many = h;
    many.replace(many.find("vertex 3"), 8, "vertex 99999999");
    EXPECT_NE(why(parsed_ply(many + "0 0 0\n")).find("99999999 rows are promised"), std::string::npos);
}
