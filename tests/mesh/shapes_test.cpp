/// What single generated shapes promise beyond the rest.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/shapes/blocks.h"

using namespace meshreel;

namespace {

Animation made(const char* name, std::uint32_t vertices = 900, std::uint32_t frames = 60)
{
    return *shapes::generate(*shapes::find(name), {vertices, frames});
}

/// The longest edge of a frame relative to its length in frame 0.
double largest_stretch(const Animation& animation, std::size_t f)
{
    const CornerTable table(animation.vertex_count, animation.triangles);
    const std::vector<double> before = edge_lengths(table, animation.frame(0)),
                              now = edge_lengths(table, animation.frame(f));
    double largest = 0;
    for (std::size_t e = 0; e < before.size(); ++e) largest = std::max(largest, now[e] / before[e]);
    return largest;
}

} // namespace

TEST(Wave, HasRankOneToTheLastBit)
{
    // z(v, f) z(w, g) = z(v, g) z(w, f) for all pairs: every 2 x 2 minor of the motion is exactly 0.
    const Animation wave = made("wave", 100, 9);
    const auto z = [&](std::size_t v, std::size_t f) { return double{wave.frame(f)[3 * v + 2]}; };
    for (std::size_t v = 0; v < 100; ++v)
        for (std::size_t f = 1; f < 9; ++f) {
            EXPECT_EQ(z(v, f) * z(50, 3), z(v, 3) * z(50, f));
            EXPECT_EQ(wave.frame(f)[3 * v], wave.frame(0)[3 * v]);
            EXPECT_EQ(wave.frame(f)[3 * v + 1], wave.frame(0)[3 * v + 1]);
        }
}

TEST(Cloth, NeverEntersTheBallOrTheGround)
{
    const Animation cloth = made("cloth");
    for (std::size_t f = 0; f < cloth.frame_count(); ++f)
        for (std::size_t v = 0; v < cloth.vertex_count; ++v) {
            const float* p = cloth.frame(f).data() + 3 * v;
            EXPECT_GE(p[1], -1e-4);
            EXPECT_GE(std::sqrt(p[0] * p[0] + (p[1] - 0.75f) * (p[1] - 0.75f) + p[2] * p[2]), 0.499);
        }
}

TEST(Cloth, HangsDownWithoutBeingTorn)
{
    const Animation cloth = made("cloth");
    float lowest = 1e9f;
    for (std::size_t v = 0; v < cloth.vertex_count; ++v) lowest = std::min(lowest, cloth.frame(59)[3 * v + 1]);
    EXPECT_LT(lowest, 0.2f);
    EXPECT_NEAR(total_area(cloth.triangles, cloth.frame(59)) / total_area(cloth.triangles, cloth.frame(0)), 1.0, 0.2);
    EXPECT_LT(largest_stretch(cloth, 59), 2.5);
    EXPECT_NE(cloth.appearance.find("uv0"), nullptr);
}

TEST(Jelly, KeepsItsVolumeRoughlyAndComesToRestOnTheGround)
{
    const Animation jelly = made("jelly", 600, 100);
    const auto area = [&](std::size_t f) { return total_area(jelly.triangles, jelly.frame(f)); };
    for (std::size_t f = 0; f < 100; f += 9) EXPECT_NEAR(area(f) / area(0), 1.0, 0.35) << f;
    float lowest = 1e9f;
    for (std::size_t v = 0; v < jelly.vertex_count; ++v) lowest = std::min(lowest, jelly.frame(99)[3 * v + 1]);
    EXPECT_NEAR(lowest, 0.0f, 0.1f);
}

TEST(Walker, WalksForwardWithItsFeetOnTheGround)
{
    const Animation walker = made("walker", 2000, 50);
    for (std::size_t f = 0; f < 50; ++f) {
        float lowest = 1e9f, highest = -1e9f;
        for (std::size_t v = 0; v < walker.vertex_count; ++v) {
            lowest = std::min(lowest, walker.frame(f)[3 * v + 1]);
            highest = std::max(highest, walker.frame(f)[3 * v + 1]);
        }
        EXPECT_NEAR(lowest, 0.0f, 0.03f);
        EXPECT_NEAR(highest, 1.7f, 0.12f);
    }
    EXPECT_GT(walker.frame(49)[2] - walker.frame(0)[2], 1.5f);
}

TEST(Walker, NamesTheGroupAndMaterialOfEveryTriangle)
{
    const Animation walker = made("walker", 2000, 1);
    for (const auto& [name, names] :
         {std::pair{"group", walker.appearance.groups}, {"material", walker.appearance.materials}}) {
        const Attribute* attribute = walker.appearance.find(name);
        ASSERT_NE(attribute, nullptr);
        EXPECT_EQ(attribute->value_count(), walker.triangles.size());
        std::set<std::uint8_t> used;
        for (std::size_t i = 0; i < attribute->values.size(); i += 4) used.insert(attribute->values[i]);
        EXPECT_EQ(used.size(), names.size()) << "each name is used";
    }
}

TEST(Snake, KeepsItsEdgesNearlyAsLongWhileItCrawls)
{
    const Animation snake = made("snake", 1500, 40);
    EXPECT_LT(largest_stretch(snake, 39), 2.0);
}

TEST(Blocks, HaveTheVerticesAskedForAndOutwardNormals)
{
    const shapes::Blocks cube{{{{-1, 1}, {-1, 1}, {-1, 1}}}, {{0, 0, 0}}};
    for (std::uint32_t vertices : {8u, 9u, 26u, 100u, 1001u}) {
        const shapes::Body body = shapes::block_surface(cube, vertices);
        EXPECT_EQ(body.points.size(), vertices);
        double volume = 0;
        for (const Triangle& t : body.triangles) {
            const auto &a = body.points[t[0]], &b = body.points[t[1]], &c = body.points[t[2]];
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0])) /
                      6;
        }
        EXPECT_NEAR(volume, 8.0, 1e-12);
    }
}
