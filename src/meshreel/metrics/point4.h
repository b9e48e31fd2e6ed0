/// Points and vectors in space-time.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace meshreel::metrics {

using Point4 = std::array<double, 4>; ///< x y z and time, model units

inline Point4 operator-(const Point4& a, const Point4& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}
inline double dot(const Point4& a, const Point4& b)
{
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

/// The vector at right angles to three others, as long as the box that they span has volume.
inline Point4 normal(const Point4& a, const Point4& b, const Point4& c)
{
    const auto minor = [&](std::size_t i, std::size_t j) { return b[i] * c[j] - b[j] * c[i]; };
    const double xy = minor(0, 1), xz = minor(0, 2), xw = minor(0, 3);
    const double yz = minor(1, 2), yw = minor(1, 3), zw = minor(2, 3);
    return {a[1] * zw - a[2] * yw + a[3] * yz, -(a[0] * zw - a[2] * xw + a[3] * xz), a[0] * yw - a[1] * xw + a[3] * xy,
            -(a[0] * yz - a[1] * xz + a[2] * xy)};
}

} // namespace meshreel::metrics
