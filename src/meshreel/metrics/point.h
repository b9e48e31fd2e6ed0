/// Points in space, in double precision.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace meshreel::metrics {

using Point = std::array<double, 3>;

inline Point plus(const Point& a, const Point& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline Point minus(const Point& a, const Point& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Point times(double s, const Point& a)
{
    return {s * a[0], s * a[1], s * a[2]};
}

inline double dot(const Point& a, const Point& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point cross(const Point& a, const Point& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The point at t of the way from a to b.
inline Point between(const Point& a, const Point& b, double t)
{
    return plus(a, times(t, minus(b, a)));
}

inline double squared_distance(const Point& a, const Point& b)
{
    const Point rest = minus(a, b);
    return dot(rest, rest);
}

} // namespace meshreel::metrics
