/// Which parallelograms a vertex can complete.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/connectivity/parallelograms.h"
#include "meshreel/connectivity/trace.h"
#include "meshreel/mesh/test_shapes.h"

using namespace meshreel;

TEST(Parallelograms, AreOneForEveryEdgeWhoseLaterTipComesLast)
{
    connectivity::Surface surface;
    surface.vertex_count = 4;
    surface.triangles = {{0, 1, 2}, {2, 1, 3}};
    const auto found = connectivity::parallelograms(surface);
    ASSERT_EQ(found.all.size(), 1u);
    ASSERT_EQ(found.of(3).size(), 1u);
    EXPECT_EQ(found.of(3)[0].opposite, 0u);
    EXPECT_EQ(found.of(3)[0].left + found.of(3)[0].right, 3u);
}

TEST(Parallelograms, LeanOnEarlierVerticesOnlyOnEveryShape)
{
    for (const auto& [name, animation] : test_shapes::all()) {
        const auto surface = connectivity::trace(animation.vertex_count, animation.triangles).surface;
        const auto found = connectivity::parallelograms(surface);
        for (std::uint32_t v = 0; v < surface.vertex_count; ++v)
            for (const auto& p : found.of(v)) EXPECT_TRUE(p.left < v && p.right < v && p.opposite < v) << name;
    }
}
