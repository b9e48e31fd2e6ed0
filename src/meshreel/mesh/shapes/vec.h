/// Three numbers as a point or a vector, for the generators.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace meshreel::shapes {

using Vec = std::array<double, 3>;

constexpr double pi = 3.14159265358979323846;

inline Vec operator+(const Vec& a, const Vec& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec operator-(const Vec& a, const Vec& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec operator*(double s, const Vec& a)
{
    return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vec& a, const Vec& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double length(const Vec& a)
{
    return std::sqrt(dot(a, a));
}

/// Rises smoothly from 0 at low to 1 at high.
inline double smooth_step(double low, double high, double x)
{
    const double t = x <= low ? 0.0 : x >= high ? 1.0 : (x - low) / (high - low);
    return t * t * (3.0 - 2.0 * t);
}

} // namespace meshreel::shapes
