/// Measures that take frames as they come say what they say of all frames at once.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"

using namespace meshreel;
using namespace meshreel::metrics;

namespace {

Animation jelly(std::uint32_t frames)
{
    return *shapes::generate(*shapes::find("jelly"), {.vertices = 400, .frames = frames});
}

Animation shaken(Animation animation)
{
    Random random(5);
    for (float& value : animation.positions) value += static_cast<float>(random.uniform(-1e-3, 1e-3));
    return animation;
}

/// Frames first .. first + count - 1, as many as there are.
Pair<float> run_of(const Pair<float>& pair, std::size_t first, std::size_t count)
{
    const std::size_t rows = std::min(count, pair.frame_count() - first);
    return {{pair.original.row(first).data(), rows, pair.original.cols},
            {pair.distorted.row(first).data(), rows, pair.distorted.cols},
            pair.triangles};
}

} // namespace

TEST(RunningMeasures, AreTheSameToTheBitHoweverFramesAreCut)
{
    for (const std::uint32_t frames : {1u, 4u, 6u, 31u}) {
        const Animation original = jelly(frames), distorted = shaken(original);
        const Sted whole = sted(pair_of(original, distorted));
        for (const std::size_t length : {1u, 3u, 8u, 20u}) {
            RunningSted running(original.vertex_count, original.triangles);
            RunningKg kg;
            RunningVertexError error;
            for (std::size_t f = 0; f < frames; f += length) {
                const Pair<float> run = run_of(pair_of(original, distorted), f, length);
                running.add(run);
                kg.add(run);
                error.add(run);
            }
            const Sted cut = running.finish();
            EXPECT_EQ(cut.spatial, whole.spatial);
            EXPECT_EQ(cut.temporal, whole.temporal);
            EXPECT_EQ(kg.value(), kg_error(original, distorted));
            EXPECT_EQ(error.value().mean_square, vertex_error(original, distorted).mean_square);
            EXPECT_EQ(error.value().largest_square, vertex_error(original, distorted).largest_square);
        }
    }
}
