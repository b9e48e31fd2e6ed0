/// validate() names what is wrong with an animation and where.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "meshreel/base/id.h"
#include "meshreel/mesh/animation.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// "field: message" of a spoiled torus (128 vertices, 256 triangles, 12 frames), or "valid".
std::string verdict(const std::function<void(Animation&)>& spoil)
{
    Animation animation = test_shapes::torus();
    spoil(animation);
    const Status status = validate(animation);
    if (status.ok()) return "valid";
    EXPECT_EQ(status.error().code, ErrorCode::bad_input);
    return status.error().sentence();
}

Attribute table(Domain domain, std::size_t value_count)
{
    return {"uv0", domain, Scalar::f32, 2, false, Bytes(value_count * 8), {}};
}
std::string verdict(const Attribute& attribute)
{
    return verdict([&](Animation& a) { a.appearance.attributes.push_back(attribute); });
}

/// A "material" table of the torus with one number everywhere, for two names.
std::string verdict_of_material(std::uint8_t number)
{
    return verdict([&](Animation& a) {
        Attribute material{"material", Domain::triangle, Scalar::u32, 1, false, {}, {}};
        for (std::size_t t = 0; t < 256; ++t) material.values.insert(material.values.end(), {number, 0, 0, 0});
        a.appearance.materials = {"red", "blue"};
        a.appearance.attributes.push_back(material);
    });
}

} // namespace

TEST(Validate, AcceptsAnAnimationOfAnyConnectivity)
{
    for (const auto& [name, animation] : test_shapes::all()) EXPECT_TRUE(validate(animation).ok()) << name;
}

TEST(Validate, NamesAnIndexOutOfRangeByTriangle)
{
    EXPECT_EQ(verdict([](Animation& a) { a.triangles[7][2] = 128; }),
              "triangles: triangle 7 names vertex 128, but there are 128 vertices");
}

TEST(Validate, NamesNotANumberAndInfinityByFrameVertexAndAxis)
{
    EXPECT_EQ(verdict([](Animation& a) { a.frame(3)[3 * 17 + 1] = not_a_number; }),
              "positions: frame 3, vertex 17, y is not a number");
    EXPECT_EQ(verdict([](Animation& a) { a.frame(11)[3 * 127 + 2] = -infinity; }),
              "positions: frame 11, vertex 127, z is infinite");
}

TEST(Validate, NamesSizesThatDisagree)
{
    EXPECT_EQ(verdict([](Animation& a) { a.positions.pop_back(); }),
              "positions: 4607 numbers for 12 frames of 128 vertices");
    EXPECT_EQ(verdict([](Animation& a) { a.times_s.clear(); }), "frame_count: there is no frame");
    EXPECT_EQ(verdict([](Animation& a) { a.vertex_count = 0; }), "vertex_count: there is no vertex");
}

TEST(Validate, NamesTimesThatDoNotIncrease)
{
    EXPECT_EQ(verdict([](Animation& a) { a.times_s[5] = a.times_s[4]; }),
              "times: frame 5 is not later than the frame before it");
    EXPECT_EQ(verdict([](Animation& a) { a.times_s[2] = not_a_number; }), "times: the time of frame 2 is not finite");
    EXPECT_EQ(verdict([](Animation& a) { a.times_s[0] = -infinity; }), "times: the time of frame 0 is not finite");
}

TEST(Validate, NamesMetadataThatMakesNoSense)
{
    EXPECT_EQ(verdict([](Animation& a) { a.meta.fps = -1; }), "fps: is neither unknown (0) nor above 0");
    EXPECT_EQ(verdict([](Animation& a) { a.meta.metres_per_unit = not_a_number; }),
              "metres_per_unit: is neither unknown (0) nor above 0");
}

TEST(Validate, AcceptsAttributesOfEveryDomainWithAndWithoutIndices)
{
    EXPECT_EQ(verdict(table(Domain::vertex, 128)), "valid");
    EXPECT_EQ(verdict(table(Domain::corner, 768)), "valid");
    EXPECT_EQ(verdict(table(Domain::triangle, 256)), "valid");
    Attribute indexed = table(Domain::corner, 3);
    indexed.indices.assign(768, 2);
    indexed.indices[5] = VertexId::none;
    EXPECT_EQ(verdict(indexed), "valid");
}

TEST(Validate, NamesAnAttributeThatDoesNotFit)
{
    EXPECT_EQ(verdict(table(Domain::vertex, 127)), "uv0: 127 entries for 128 elements");
    Attribute indexed = table(Domain::triangle, 3);
    indexed.indices.assign(256, 3);
    EXPECT_EQ(verdict(indexed), "uv0: index 3 is beyond its 3 values");
    Attribute odd = table(Domain::vertex, 128);
    odd.values.pop_back();
    EXPECT_EQ(verdict(odd), "uv0: its values are not a whole number of components");
    odd.components = 0;
    EXPECT_EQ(verdict(odd), "uv0: 0 numbers a value, but 1 to 16 are possible");
    odd.components = 17;
    EXPECT_EQ(verdict(odd), "uv0: 17 numbers a value, but 1 to 16 are possible");
}

TEST(Validate, NamesAMaterialOrGroupWithoutAName)
{
    EXPECT_EQ(verdict_of_material(1), "valid");
    EXPECT_EQ(verdict_of_material(2), "material: number 2 is beyond the 2 names");
    Attribute group{"group", Domain::triangle, Scalar::u8, 1, false, Bytes(256), {}};
    EXPECT_EQ(verdict(group), "group: must be one 32-bit number a triangle");
}

TEST(Animation, BodyDiagonalIsThatOfTheFirstFramesBox)
{
    Animation animation;
    animation.vertex_count = 2;
    animation.positions = {1, 1, 1, 3, 4, 7, 100, 100, 100, 0, 0, 0};
    animation.times_s = uniform_times(2, 25.0);
    EXPECT_DOUBLE_EQ(body_diagonal(animation), 7.0);
    EXPECT_DOUBLE_EQ(animation.times_s[1], 0.04);
}

TEST(Appearance, FindsAnAttributeByName)
{
    Appearance appearance;
    appearance.attributes.push_back(table(Domain::vertex, 1));
    EXPECT_EQ(appearance.find("uv0"), appearance.attributes.data());
    EXPECT_EQ(appearance.find("uv1"), nullptr);
}
