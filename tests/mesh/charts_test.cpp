/// What charts and wedges are.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/mesh/charts.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

namespace {

/// Two squares side by side, four triangles.
const std::vector<Triangle> two_squares{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};

Appearance with_corner_values(std::vector<std::uint32_t> indices)
{
    Attribute uv{"uv0", Domain::corner, Scalar::u8, 1, false, {0, 1, 2, 3, 4, 5, 6, 7, 4}, std::move(indices)};
    return {{uv}, {}, {}, {}};
}

} // namespace

TEST(Charts, AreOneWhereNothingDiffers)
{
    const std::vector<std::uint32_t> wedges = wedges_of(two_squares, {});
    EXPECT_EQ(wedges[0], wedges[3]);
    EXPECT_NE(wedges[0], wedges[1]);
    EXPECT_EQ(charts_of(two_squares, wedges), (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

TEST(Charts, EndWhereTheValuesOfCornersDiffer)
{
    const auto seam =
        with_corner_values({0, 1, 4, 0, 4, 3, 6, 2, 5, 6, 5, 7}); // 1 and 4 have other values on the right
    EXPECT_EQ(charts_of(two_squares, wedges_of(two_squares, seam)), (std::vector<std::uint32_t>{0, 0, 2, 2}));
}

TEST(Charts, DoNotEndWhereEqualValuesHaveSeveralNumbers)
{
    const auto same = with_corner_values({0, 1, 4, 0, 8, 3, 1, 2, 5, 1, 5, 4}); // 8 is 4 again
    EXPECT_EQ(charts_of(two_squares, wedges_of(two_squares, same)), (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

TEST(Charts, EndAtDoubledVertices)
{
    const std::vector<Triangle> file{{0, 1, 4}, {0, 4, 3}, {6, 2, 5}, {6, 5, 7}}; // 6 is 1 again, 7 is 4
    EXPECT_EQ(charts_of(two_squares, wedges_of(file, {})), (std::vector<std::uint32_t>{0, 0, 2, 2}));
}

TEST(Charts, OfWhateverShapeAreNamedByTheirFirstTriangles)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const auto charts = charts_of(animation.triangles, wedges_of(animation.triangles, animation.appearance));
        ASSERT_EQ(charts.size(), animation.triangles.size());
        for (std::uint32_t t = 0; t < charts.size(); ++t) {
            EXPECT_LE(charts[t], t) << name;
            EXPECT_EQ(charts[charts[t]], charts[t]) << name;
        }
    }
}
