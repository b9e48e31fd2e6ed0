/// What the measure "hausdorff" promises.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/hausdorff.h"

#include <gtest/gtest.h>

#include "meshreel/metrics/measure.h"
#include "tests/metrics/surfaces.h"

using namespace meshreel;
using namespace meshreel::metrics;
using namespace meshreel::metrics::test;

namespace {

enum Found { mean, mean_upper, forward, backward, most, most_upper, rms, rms_forward, rms_backward };

/// The surfaces, one a frame, all of the same triangles.
Animation animated(const std::vector<Surface>& surfaces)
{
    Animation made;
    made.triangles = surfaces[0].triangles;
    made.vertex_count = static_cast<std::uint32_t>(surfaces[0].positions.size() / 3);
    made.times_s = uniform_times(surfaces.size(), 25);
    for (const Surface& surface : surfaces)
        made.positions.insert(made.positions.end(), surface.positions.begin(), surface.positions.end());
    return made;
}

Animation without_points(std::size_t frames)
{
    Animation made;
    made.times_s = uniform_times(frames, 25);
    return made;
}

Measured hausdorff(const Animation& a, const Animation& b, std::vector<std::pair<const char*, double>> set = {})
{
    Wanted wanted{find("hausdorff")};
    for (const auto& [name, value] : set)
        EXPECT_TRUE(set_parameter(*wanted.metric, name, value, wanted.parameters).ok());
    return *measure(a, b, wanted);
}

/// A large square and a quarter of it, a height above.
const Animation whole = animated({square(4, 0), square(4, 0)});
Animation quarter()
{
    Animation made = animated({square(3, 0.25f), square(3, 0.5f)});
    for (std::size_t i = 0; i < made.positions.size(); ++i)
        if (i % 3 != 2) made.positions[i] /= 2;
    return made;
}

} // namespace

TEST(Hausdorff, OfSquaresOfOtherTrianglesIsKnownInClosedForm)
{
    const Measured found = hausdorff(whole, quarter());
    const double one = std::sqrt(0.5 + 1.0 / 16), two = std::sqrt(0.5 + 0.25); // the far corner to the near one
    EXPECT_NEAR(found.values[forward], (one + two) / 2, 1e-10);
    EXPECT_NEAR(found.values[backward], (0.25 + 0.5) / 2, 1e-10);
    EXPECT_NEAR(found.values[mean], (one + two) / 2, 1e-10);
    EXPECT_NEAR(found.values[most], two, 1e-10);
    EXPECT_NEAR(found.values[most_upper], two, 1e-10);
    EXPECT_NEAR(found.values[rms_backward], 0.375, 1e-10);
    EXPECT_NEAR(found.per_frame[1], two, 1e-10);
}

TEST(Hausdorff, RmsOfSquaresApproachesItsIntegral)
{
    // Outside the quarter: mean of max(x - 1/2, 0)^2 + max(y - 1/2, 0)^2 over the unit square is 1/12.
    const Measured found = hausdorff(whole, quarter(), {{"samples", 200000}});
    EXPECT_NEAR(found.values[rms_forward], (std::sqrt(1.0 / 16 + 1.0 / 12) + std::sqrt(0.25 + 1.0 / 12)) / 2, 1e-3);
    EXPECT_EQ(found.values[rms], found.values[rms_forward]);
}

TEST(Hausdorff, IsTheSameWhicheverAnimationIsTheOriginal)
{
    const Animation other = quarter();
    const Measured one = hausdorff(whole, other), two = hausdorff(other, whole);
    EXPECT_NEAR(one.values[mean], two.values[mean], 1e-10);
    EXPECT_EQ(one.values[forward], two.values[backward]);
    EXPECT_EQ(one.values[rms], two.values[rms]);
}

TEST(Hausdorff, BySamplingIsALowerBoundWithoutAnUpperOne)
{
    const Animation one = animated({sphere(10, 1)}), two = animated({noisy(sphere(7, 1), 0.05)});
    const Measured exact = hausdorff(one, two), sampled = hausdorff(one, two, {{"sampling", 1}, {"samples", 50000}});
    EXPECT_LE(sampled.values[mean], exact.values[mean_upper]);
    EXPECT_GT(sampled.values[mean], 0.98 * exact.values[mean]);
    EXPECT_EQ(sampled.values[mean_upper], HUGE_VAL);
    EXPECT_EQ(sampled.values[rms], hausdorff(one, two, {{"samples", 50000}}).values[rms]);
    EXPECT_NE(sampled.values[rms], hausdorff(one, two, {{"samples", 50000}, {"seed", 2}}).values[rms]);
}

TEST(Hausdorff, BoundsStayTrueWhenTheWorkIsCutShort)
{
    const Animation one = animated({sphere(10, 1)}), two = animated({noisy(sphere(7, 1), 0.05)});
    const Measured exact = hausdorff(one, two), quick = hausdorff(one, two, {{"most_cuts", 0}});
    EXPECT_LE(quick.values[mean], exact.values[mean_upper]);
    EXPECT_GE(quick.values[mean_upper], exact.values[mean]);
    EXPECT_GT(quick.values[mean_upper] - quick.values[mean], 1e-6);
}

TEST(Hausdorff, TellsEveryOriginalVertexItsDistance)
{
    std::vector<double> told;
    Wanted wanted{find("hausdorff")};
    wanted.vertex_errors = [&](std::size_t, std::span<const double> errors) {
        told.insert(told.end(), errors.begin(), errors.end());
    };
    ASSERT_TRUE(measure(quarter(), whole, wanted).ok());
    ASSERT_EQ(told.size(), 2 * 16u);
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_DOUBLE_EQ(told[i], i < 16 ? 0.25 : 0.5);
}

TEST(Hausdorff, OfPointsWithoutTrianglesIsThatOfThePoints)
{
    const Animation one = animated({{{}, {0, 0, 0, 1, 0, 0}}}), two = animated({{{}, {0, 3, 4}}});
    const Measured found = hausdorff(one, two);
    EXPECT_DOUBLE_EQ(found.values[forward], std::sqrt(26.0));
    EXPECT_DOUBLE_EQ(found.values[backward], 5);
    EXPECT_DOUBLE_EQ(found.values[rms_backward], 5);
}

TEST(Hausdorff, DoesNotSeeVerticesWithoutATriangleNextToTriangles)
{
    Surface with = square(1, 0);
    with.positions.insert(with.positions.end(), {9, 9, 9});
    EXPECT_EQ(hausdorff(animated({with}), animated({square(1, 0)})).values[mean_upper], 0);
}

TEST(Hausdorff, OfNothingIsZeroToNothingAndInfiniteToSomething)
{
    EXPECT_EQ(hausdorff(without_points(2), without_points(2)).values[mean], 0);
    const Measured found = hausdorff(whole, without_points(2));
    EXPECT_EQ(found.values[forward], HUGE_VAL);
    EXPECT_EQ(found.values[backward], 0);
    EXPECT_EQ(found.values[mean], HUGE_VAL);
    EXPECT_EQ(hausdorff(without_points(0), without_points(0)).values[mean], 0);
}
