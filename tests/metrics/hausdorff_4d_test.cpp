/// What the Hausdorff distance in space-time promises.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "meshreel/mesh/shapes.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/metrics/hausdorff_4d.h"

using namespace meshreel;
using namespace meshreel::metrics;

namespace {

MovingMesh moving(const Animation& a)
{
    return {a, {a.positions.data(), a.frame_count(), 3ul * a.vertex_count}};
}

Hausdorff4d distances(const Animation& a, const Animation& b, const Hausdorff4dOptions& options = {})
{
    return hausdorff_4d(moving(a), moving(b), options);
}

/// A square grid of n x n cells, side 1, that `place` puts somewhere at each time.
Animation sheet(std::uint32_t n, std::vector<double> times,
                const std::function<std::array<double, 3>(double, double, double)>& place)
{
    Animation a;
    a.vertex_count = (n + 1) * (n + 1);
    a.times_s = std::move(times);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t v = i * (n + 1) + j;
            a.triangles.insert(a.triangles.end(), {{v, v + 1, v + n + 1}, {v + 1, v + n + 2, v + n + 1}});
        }
    for (const double t : a.times_s)
        for (std::uint32_t v = 0; v < a.vertex_count; ++v)
            for (const double x : place(v % (n + 1) / static_cast<double>(n), v / (n + 1) / static_cast<double>(n), t))
                a.positions.push_back(static_cast<float>(x));
    return a;
}

Animation still_sheet(std::uint32_t n, double height, std::vector<double> times = {0.0, 0.5, 1.0})
{
    return sheet(n, std::move(times), [=](double x, double y, double) { return std::array{x, y, height}; });
}

/// A tube closed by its poles, radius 1, that moves along x at 0.5 a second.
Animation ball(std::uint32_t rings, std::uint32_t sides, std::size_t frames)
{
    Animation a;
    a.vertex_count = rings * sides + 2;
    a.times_s = uniform_times(frames, static_cast<double>(frames - 1));
    for (std::uint32_t s = 0; s < sides; ++s) {
        const std::uint32_t next = (s + 1) % sides, last = (rings - 1) * sides;
        a.triangles.push_back({a.vertex_count - 2, next, s});
        a.triangles.push_back({a.vertex_count - 1, last + s, last + next});
        for (std::uint32_t r = 0; r + 1 < rings; ++r) {
            const std::uint32_t v = r * sides + s, w = r * sides + next;
            a.triangles.insert(a.triangles.end(), {{v, w, v + sides}, {w, w + sides, v + sides}});
        }
    }
    for (const double t : a.times_s) {
        const auto put = [&](double polar, double turn) {
            for (const double x :
                 {std::sin(polar) * std::cos(turn) + 0.5 * t, std::sin(polar) * std::sin(turn), std::cos(polar)})
                a.positions.push_back(static_cast<float>(x));
        };
        for (std::uint32_t r = 0; r < rings; ++r)
            for (std::uint32_t s = 0; s < sides; ++s) put(M_PI * (r + 1) / (rings + 1), 2 * M_PI * s / sides);
        put(0.0, 0.0);
        put(M_PI, 0.0);
    }
    return a;
}

void expect_all_zero(const Hausdorff4d& h, const std::string& name)
{
    for (const Directed4d* d : {&h.forward, &h.backward})
        for (const double x : {d->vertices.largest, d->vertices.mean, d->vertices.rms, d->samples.largest,
                               d->samples.mean, d->samples.rms, d->lower(), d->upper})
            EXPECT_EQ(x, 0.0) << name;
}

} // namespace

TEST(Hausdorff4d, OfEqualAnimationsIsExactlyZero)
{
    for (const auto& [name, a] : test_shapes::all()) expect_all_zero(distances(a, a), name);
    const Animation fish = *shapes::generate(*shapes::find("swimmer"), {.vertices = 500, .frames = 10});
    expect_all_zero(distances(fish, fish, {.samples = 20}), "swimmer");
}

TEST(Hausdorff4d, OfStillPlanesIsTheirDistance) // also of planes with other triangles and other frames
{
    const double expected = 0.25 / std::sqrt(2.0);
    for (const Hausdorff4d& h : {distances(still_sheet(4, 0), still_sheet(4, 0.25)),
                                 distances(still_sheet(4, 0), still_sheet(7, 0.25, {0.0, 0.3, 0.6, 0.7, 1.0}))})
        for (const Directed4d* d : {&h.forward, &h.backward}) {
            for (const double x : {d->vertices.largest, d->vertices.mean, d->vertices.rms, d->samples.largest,
                                   d->samples.mean, d->samples.rms})
                EXPECT_NEAR(x, expected, 1e-7);
            EXPECT_GE(d->upper, expected);
        }
    EXPECT_NEAR(distances(still_sheet(4, 0), still_sheet(4, 0.25)).forward.upper, expected, 1e-7); // vertex for vertex
}

TEST(Hausdorff4d, OfASheetThatStandsStillLaterIsTheTimeTimesAlpha)
{
    const Animation early = still_sheet(3, 0), late = still_sheet(3, 0, {0.1, 0.6, 1.1});
    for (const double alpha : {0.3, 0.1, 2.0}) {
        const Hausdorff4d h = distances(early, late, {.time_constant = alpha});
        EXPECT_NEAR(h.forward.vertices.largest, alpha * 0.1, 1e-12);
        EXPECT_NEAR(h.backward.vertices.largest, alpha * 0.1, 1e-12);
        EXPECT_NEAR(h.forward.vertices.mean, alpha * 0.1 / 3, 1e-12); // two of three frames are in the other one's time
        EXPECT_LE(h.forward.samples.largest, alpha * 0.1 + 1e-12);
    }
}

TEST(Hausdorff4d, OfAMovingPlaneThatIsLateIsTheDistanceOfParallelHyperplanes)
{
    const auto rising = [](double late) {
        return sheet(3, uniform_times(21, 10.0), [=](double x, double y, double t) {
            return std::array{x, y, t - late};
        });
    };
    const double D = std::sqrt(2.0), units = 0.3 * D;
    std::vector<double> middle;
    const Animation a = rising(0.0), b = rising(0.1);
    hausdorff_4d(moving(a), moving(b), {.samples = 0},
                 {[&](std::size_t f, std::span<const double> errors) {
                      if (f == 10) middle.assign(errors.begin(), errors.end());
                  },
                  {}});
    ASSERT_EQ(middle.size(), a.vertex_count);
    for (const double x : middle) EXPECT_NEAR(x, 0.1 * units / std::hypot(1.0, units) / D, 1e-7);
}

TEST(Hausdorff4d, OfOneMotionInOtherFramesIsNothing)
{
    const auto rising = [](std::vector<double> times) {
        return sheet(3, std::move(times), [=](double x, double y, double t) { return std::array{x, y, t / 2}; });
    };
    const Hausdorff4d h = distances(rising({0.0, 1.0}), rising({0.0, 0.125, 0.25, 0.75, 1.0}));
    EXPECT_LT(h.forward.lower(), 1e-12);
    EXPECT_LT(h.backward.lower(), 1e-12);
}

TEST(Hausdorff4d, OfOneBallInOtherTrianglesShrinksAsTheyDo)
{
    const Animation fine = ball(40, 80, 5);
    double before = 1.0;
    for (const std::uint32_t n : {4u, 8u, 16u}) {
        const Hausdorff4d h = distances(fine, ball(n, 2 * n, 3), {.samples = 1});
        EXPECT_LT(h.forward.lower(), before / 2);
        EXPECT_LT(h.backward.vertices.largest, 0.002); // its vertices lie on the sphere, but for the fine one's facets
        EXPECT_GE(h.forward.upper, h.forward.lower());
        before = h.forward.lower();
    }
}

TEST(Hausdorff4d, OfSingleFramesIsThatOfTheSurfaces)
{
    const Animation a = still_sheet(2, 0, {1.0}), b = still_sheet(3, 0.5, {1.0});
    const Hausdorff4d h = distances(a, b);
    EXPECT_NEAR(h.forward.samples.mean, 0.5 / std::sqrt(2.0), 1e-7);
    EXPECT_NEAR(h.backward.vertices.largest, 0.5 / std::sqrt(2.0), 1e-7);
    const double later =
        distances(a, still_sheet(2, 0, {3.0, 4.0})).forward.vertices.mean; // two seconds before it begins
    EXPECT_NEAR(later, 0.3 * 2.0, 1e-7);
}

TEST(Hausdorff4d, IsBetweenItsBounds)
{
    const Animation a = *shapes::generate(*shapes::find("jelly"), {.vertices = 300, .frames = 8, .seed = 1});
    const Animation b = *shapes::generate(*shapes::find("jelly"), {.vertices = 200, .frames = 12, .seed = 2});
    const Hausdorff4d few = distances(a, b, {.samples = 0.05}), many = distances(a, b, {.samples = 8});
    for (const auto side : {&Hausdorff4d::forward, &Hausdorff4d::backward}) {
        EXPECT_LE((many.*side).lower(), (few.*side).upper);
        EXPECT_NEAR((many.*side).samples.mean, (few.*side).samples.mean, 0.05 * (many.*side).samples.mean);
        EXPECT_GT((many.*side).lower(), 0.0);
    }
}

TEST(Hausdorff4d, IsTheSameForAnyNumberOfThreadsAndAnotherWithAnotherSeed)
{
    const Animation a = *shapes::generate(*shapes::find("jelly"), {.vertices = 300, .frames = 5});
    const Animation b = *shapes::generate(*shapes::find("jelly"), {.vertices = 200, .frames = 5, .seed = 2});
    const Hausdorff4d one = distances(a, b, {.threads = {1}}), three = distances(a, b, {.threads = {3}});
    EXPECT_EQ(one.forward.samples.rms, three.forward.samples.rms);
    EXPECT_EQ(one.backward.vertices.mean, three.backward.vertices.mean);
    EXPECT_NE(one.forward.samples.rms, distances(a, b, {.seed = 5}).forward.samples.rms);
}

TEST(Hausdorff4d, OfNoTrianglesIsInfiniteOrNothingButNeverNaN)
{
    const Animation points = test_shapes::points_only(), torus = test_shapes::torus();
    const Hausdorff4d h = distances(torus, points);
    EXPECT_EQ(h.forward.lower(), HUGE_VAL);
    EXPECT_EQ(h.forward.samples.mean, HUGE_VAL);
    EXPECT_EQ(h.backward.lower(), 0.0);
    expect_all_zero(distances(points, points), "points");
    Animation collapsed = torus;
    for (float& x : collapsed.positions) x = 1.0f;
    for (const Directed4d& d : {distances(collapsed, torus).forward, distances(torus, collapsed).forward})
        for (const double x : {d.vertices.rms, d.samples.mean, d.samples.rms, d.upper}) EXPECT_TRUE(std::isfinite(x));
}

TEST(Hausdorff4d, IsTheSameInHugeAndTinyUnits)
{
    const auto scaled = [](Animation a, float by) {
        for (float& x : a.positions) x *= by;
        return a;
    };
    const Animation a = test_shapes::torus(), b = test_shapes::double_torus();
    const double usual = distances(a, b).forward.samples.mean;
    for (const float by : {0x1p-100f, 0x1p100f})
        EXPECT_NEAR(distances(scaled(a, by), scaled(b, by)).forward.samples.mean, usual, 1e-9 * usual);
    Animation late = scaled(a, 0x1p120f);
    for (double& t : late.times_s) t *= 1e12;
    for (const double alpha : {1e-6, 1e6}) {
        const Hausdorff4d h = distances(late, b, {.time_constant = alpha});
        for (const Directed4d& d : {h.forward, h.backward})
            for (const double x : {d.lower(), d.upper, d.vertices.rms, d.samples.mean, d.samples.rms})
                EXPECT_FALSE(std::isnan(x));
    }
}

TEST(Hausdorff4d, TellsItsProgressFromNothingToAll)
{
    const Animation a = test_shapes::torus();
    std::vector<double> told;
    hausdorff_4d(moving(a), moving(a), {.samples = 0.1}, {{}, [&](std::string_view, double x) { told.push_back(x); }});
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.size(), 2 * a.frame_count());
    EXPECT_EQ(told.back(), 1.0);
}
