/// What every generated shape promises.
// SPDX-License-Identifier: MIT
#include <cstring>
#include <gtest/gtest.h>
#include <map>

#include "meshreel/mesh/measures.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/metrics/kg.h"

using namespace meshreel;
using shapes::ShapeOptions;

namespace {

class EveryShape : public testing::TestWithParam<shapes::Shape> {
protected:
    Animation make(std::uint32_t vertices, std::uint32_t frames, std::uint64_t seed = 1, double fps = 25.0) const
    {
        auto made = shapes::generate(GetParam(), {vertices, frames, fps, seed});
        EXPECT_TRUE(made.ok());
        return *std::move(made);
    }
    ErrorCode refusal(const ShapeOptions& options) const
    {
        const auto made = shapes::generate(GetParam(), options);
        return made.ok() ? ErrorCode::runtime : made.error().code;
    }
};

/// FNV-1a of triangles and positions.
std::uint64_t digest(const Animation& animation)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const void* bytes, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3u;
    };
    add(animation.triangles.data(), animation.triangles.size() * sizeof(Triangle));
    add(animation.positions.data(), animation.positions.size() * sizeof(float));
    return hash;
}

} // namespace

TEST_P(EveryShape, HasExactlyTheVerticesAndFramesAskedFor)
{
    const std::uint32_t least = GetParam().minimum_vertices;
    for (std::uint32_t vertices : {least, least + 1, least + 7, 233u, 1000u})
        for (std::uint32_t frames : {1u, 3u}) {
            const Animation animation = make(vertices, frames);
            EXPECT_EQ(animation.vertex_count, vertices);
            EXPECT_EQ(animation.frame_count(), frames);
        }
}

TEST_P(EveryShape, IsValidAndOneManifoldWithoutDegenerateTriangles)
{
    for (std::uint32_t vertices : {GetParam().minimum_vertices, 233u, 1500u}) {
        const Animation animation = make(vertices, 4);
        EXPECT_TRUE(validate(animation).ok());
        const Topology topology = describe(animation.vertex_count, animation.triangles);
        EXPECT_EQ(topology.components, 1u);
        EXPECT_EQ(topology.isolated_vertices + topology.degenerate_triangles + topology.duplicated_triangles, 0u);
        EXPECT_EQ(topology.nonmanifold_edges + topology.nonmanifold_vertices + topology.inconsistent_edges, 0u);
        EXPECT_EQ(topology.euler, topology.boundary_loops == 0 ? 2 : 1) << "a sphere or a sheet";
    }
}

TEST_P(EveryShape, IsTheSameForTheSameSeedAndAnotherForAnother)
{
    EXPECT_EQ(digest(make(300, 10, 5)), digest(make(300, 10, 5)));
    EXPECT_NE(digest(make(300, 10, 5)), digest(make(300, 10, 6)));
}

TEST_P(EveryShape, MovesButStaysInReach)
{
    const Animation animation = make(400, 30);
    Animation still = animation;
    for (std::size_t f = 1; f < 30; ++f)
        std::copy(animation.frame(0).begin(), animation.frame(0).end(), still.frame(f).begin());
    EXPECT_GT(metrics::kg_error(animation, still), 5.0);
    for (float x : animation.positions) EXPECT_LT(std::abs(x), 20.0f);
}

TEST_P(EveryShape, ShowsTheSameMomentsAtAnyLengthAndTimesAtAnyRate)
{
    const Animation three = make(200, 3), ten = make(200, 10, 1), quick = make(200, 3, 1, 50.0);
    EXPECT_TRUE(std::equal(three.positions.begin(), three.positions.end(), ten.positions.begin()))
        << "more frames go on";
    EXPECT_EQ(quick.times_s, uniform_times(3, 50.0));
    EXPECT_EQ(quick.meta.fps, 50.0);
}

TEST_P(EveryShape, RefusesWhatItCannotMake)
{
    ShapeOptions options;
    options.vertices = GetParam().minimum_vertices - 1;
    EXPECT_EQ(refusal(options), ErrorCode::usage);
    EXPECT_EQ(refusal({2500, 0}), ErrorCode::usage);
    EXPECT_EQ(refusal({2500, 10, 0.0}), ErrorCode::usage);
    EXPECT_EQ(refusal({2500, 10, -1.0}), ErrorCode::usage);
    EXPECT_EQ(refusal({4'000'000'000u, 4'000'000'000u}), ErrorCode::usage);
    EXPECT_EQ(refusal({2500, 10, std::numeric_limits<double>::quiet_NaN()}), ErrorCode::usage);
}

TEST_P(EveryShape, IsFoundByItsName)
{
    ASSERT_NE(shapes::find(GetParam().name), nullptr);
    EXPECT_EQ(shapes::find(GetParam().name)->make, GetParam().make);
    EXPECT_EQ(shapes::find("no such shape"), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(shapes::all().begin(), shapes::all().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Shapes, HaveTheSameBytesOnEveryMachine)
{
    const std::map<std::string_view, std::uint64_t> expected{
        {"cloth", 0xf8f3b93590169ccfu}, {"jelly", 0x4e2f687fd19e3f1au},  {"swimmer", 0xacb05cd5bc63f706u},
        {"snake", 0x6a42c359fb9ab898u}, {"walker", 0x68ce1b3fdd0a26bau}, {"wave", 0xfd2f23bf8812a07bu},
    };
    for (const shapes::Shape& shape : shapes::all()) {
        const auto made = shapes::generate(shape, {500, 20, 25.0, 1});
        ASSERT_TRUE(made.ok());
        ASSERT_TRUE(expected.count(shape.name)) << shape.name << " 0x" << std::hex << digest(*made) << "u";
        EXPECT_EQ(expected.at(shape.name), digest(*made)) << shape.name << " 0x" << std::hex << digest(*made) << "u";
    }
}
