/// The three reference distortions, checked against the implementation of STED's authors to 12 to 15 digits.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "meshreel/metrics/motion.h"

namespace meshreel::reference {

constexpr std::size_t side = 12, frame_count = 8, vertex_count = side * side;

struct Vector {
    const char* distortion;
    std::array<double, 3> (*offset)(double v, double i, double j, std::size_t f);
    double sted, kg;
};

inline const std::array<Vector, 3> vectors{{
    {"x += 0.02 sin(12 v + 3 f)",
     [](double v, double, double, std::size_t f) {
         return std::array{0.02 * std::sin(12 * v + 3.0 * static_cast<double>(f)), 0.0, 0.0};
     },
     0.00342464504888153, 0.2863537747},
    {"x += 0.05 sin(0.3 i), y += 0.05 sin(0.2 j)",
     [](double, double i, double j, std::size_t) {
         return std::array{0.05 * std::sin(0.3 * i), 0.05 * std::sin(0.2 * j), 0.0};
     },
     0.00253969184948727, 1.022740971},
    {"z += 0.03 cos(7 v), plus in odd frames and minus in even ones",
     [](double v, double, double, std::size_t f) {
         return std::array{0.0, 0.0, 0.03 * std::cos(7 * v) * (f % 2 == 1 ? 1.0 : -1.0)};
     },
     0.00750845079159487, 0.4288794926},
}};

/// The grid and one of its distortions, in double precision: float32 would cost digits.
struct Grid {
    Matrix<double> original{frame_count, 3 * vertex_count}, distorted{frame_count, 3 * vertex_count};
    std::vector<Triangle> triangles;

    metrics::Pair<double> pair() const { return {original.view(), distorted.view(), triangles}; }
};

inline Grid grid(const Vector& vector)
{
    const auto rounded = [](double x) { return std::round(x * 1e8) / 1e8; };
    Grid grid;
    for (std::size_t f = 0; f < frame_count; ++f)
        for (std::size_t v = 0; v < vertex_count; ++v) {
            const double i = static_cast<double>(v / side), j = static_cast<double>(v % side),
                         t = static_cast<double>(f);
            const std::array point{j, i, 1.5 * std::sin(0.5 * i + 0.7 * t) * std::cos(0.4 * j - 0.3 * t)};
            const std::array offset = vector.offset(static_cast<double>(v), i, j, f);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                grid.original(f, 3 * v + axis) = rounded(point[axis]);
                grid.distorted(f, 3 * v + axis) = rounded(point[axis] + offset[axis]);
            }
        }
    for (std::uint32_t i = 0; i + 1 < side; ++i)
        for (std::uint32_t j = 0; j + 1 < side; ++j) {
            const auto v = static_cast<std::uint32_t>(side * i + j), below = static_cast<std::uint32_t>(v + side);
            grid.triangles.push_back({v, v + 1, below});
            grid.triangles.push_back({v + 1, below + 1, below});
        }
    return grid;
}

} // namespace meshreel::reference
