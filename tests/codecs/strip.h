/// A strip of cloth that rolls up, in a basis that is all of the space of trajectories.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "meshreel/base/random.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/basis.h"
#include "meshreel/mesh/animation.h"

namespace meshreel {

/// Trajectories [W x 3F] in a basis that is all of them can be: C holds the coordinates themselves.
struct Posed {
    codecs::Basis basis;
    Matrix<double> C;

    Posed(std::size_t W, std::size_t F) : basis{std::vector<double>(3 * F), Matrix<double>(3 * F, 3 * F)}, C(W, 3 * F)
    {
        for (std::size_t i = 0; i < 3 * F; ++i) basis.rows(i, i) = 1.0;
    }
    double distance(const Posed& other) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < C.values.size(); ++i) sum += std::pow(C.values[i] - other.C.values[i], 2);
        return std::sqrt(sum);
    }
};

inline constexpr std::uint32_t columns = 12, rows = 4;

inline std::vector<Triangle> strip()
{
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i + 1 < columns; ++i)
        for (std::uint32_t j = 0; j + 1 < rows; ++j) {
            const std::uint32_t v = i * rows + j;
            triangles.push_back({v, v + rows, v + 1});
            triangles.push_back({v + 1, v + rows, v + rows + 1});
        }
    return triangles;
}

/// A strip rolled up to ever smaller circles while the width of its last columns is scaled by stretch(time).
inline Posed rolling(std::size_t F, const std::function<double(double)>& stretch)
{
    Posed posed(columns * rows, F);
    for (std::size_t f = 0; f < F; ++f) {
        const double time = static_cast<double>(f) / static_cast<double>(F), bend = 0.02 + 0.2 * time;
        for (std::size_t v = 0; v < columns * rows; ++v) {
            const double angle = bend * static_cast<double>(v / rows);
            posed.C(v, f) = std::sin(angle) / bend;
            posed.C(v, F + f) = (1.0 - std::cos(angle)) / bend;
            posed.C(v, 2 * F + f) = static_cast<double>(v % rows) * (v / rows < 9 ? 1.0 : stretch(time));
        }
    }
    return posed;
}

inline double unstretched(double)
{
    return 1.0;
}

inline Posed noisy(Posed posed, double size)
{
    Random random(7);
    for (double& c : posed.C.values) c += size * (random.uniform() - 0.5);
    return posed;
}

} // namespace meshreel
