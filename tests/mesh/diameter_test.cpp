/// The largest distance is that of all pairs, to the bit, for every kind of point set.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string_view>

#include "meshreel/base/random.h"
#include "meshreel/mesh/diameter.h"

using namespace meshreel;

namespace {

using Maker = std::function<std::array<double, 3>(Random&)>;

Matrix<float> cloud(std::size_t count, std::uint64_t seed, const Maker& make)
{
    Matrix<float> points(count, 3);
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const std::array point = make(random);
        for (std::size_t axis = 0; axis < 3; ++axis) points(i, axis) = static_cast<float>(point[axis]);
    }
    return points;
}

double by_all_pairs(const Matrix<float>& points)
{
    double best = 0;
    for (std::size_t i = 0; i < points.rows; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double square = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                const double d = double{points(i, a)} - points(j, a);
                square += d * d;
            }
            best = std::max(best, square);
        }
    return std::sqrt(best);
}

std::array<double, 3> on_sphere(Random& random)
{
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 6.283185307179586), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

const std::vector<std::pair<const char*, Maker>> kinds{
    {"cube",
     [](Random& r) {
         return std::array{r.uniform(), r.uniform(), r.uniform()};
     }},
    {"sphere", on_sphere},
    {"far from the origin",
     [](Random& r) {
         return std::array{1e5 + r.uniform(), -1e5 + r.uniform(), 1e5 * r.uniform()};
     }},
    {"plane",
     [](Random& r) {
         return std::array{r.uniform(), 0.25, r.uniform()};
     }},
    {"tilted plane",
     [](Random& r) {
         const double u = r.uniform(), v = r.uniform();
         return std::array{u, v, u + v};
     }},
    {"circle",
     [](Random& r) {
         const double a = r.uniform(0, 6.3);
         return std::array{std::cos(a), std::sin(a), 1.0};
     }},
    {"line",
     [](Random& r) {
         const double u = r.uniform();
         return std::array{u, 2 * u, -u};
     }},
    {"one point",
     [](Random&) {
         return std::array{1.0, 2.0, 3.0};
     }},
    {"two points",
     [](Random& r) {
         return std::array{static_cast<double>(r.below(2)), 0.0, 0.0};
     }},
    {"corners of a cube",
     [](Random& r) {
         return std::array{double(r.below(2)), double(r.below(2)), double(r.below(2))};
     }},
};

} // namespace

TEST(LargestDistance, EqualsThatOfAllPairsToTheBit)
{
    for (const auto& [kind, make] : kinds)
        for (std::size_t count : {1, 2, 3, 9, 100, 1500}) {
            const Matrix<float> points = cloud(count, count, make);
            EXPECT_EQ(largest_distance(points.view()), by_all_pairs(points)) << kind << " " << count;
        }
}

TEST(LargestDistance, OfNoPointIsZero)
{
    EXPECT_EQ(largest_distance(Matrix<float>(0, 3).view()), 0.0);
}

TEST(LargestDistance, OfManyPointsIsFoundWithoutTryingAllPairs)
{
    for (const auto& [kind, make] : kinds) {
        if (std::string_view(kind) == "sphere" || std::string_view(kind) == "circle")
            continue; // many near ties take longer
        EXPECT_GE(largest_distance(cloud(300'000, 5, make).view()), 0.0) << kind;
    }
}
