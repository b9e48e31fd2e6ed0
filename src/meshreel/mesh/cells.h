/// Points sorted into the cubes of a grid: whoever is within a cube's side of a place is in one of the 27 around it.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshreel {

using Point = std::array<double, 3>;

inline double squared_gap(const Point& a, const Point& b)
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/// Points hashed by their cubes, so that those near a place are found without a look at the others.
class Cells {
public:
    /// low: no point has smaller coordinates.
    explicit Cells(const Point& low) : low_(low) {}

    /// Holds these points from now on and no others. reach > 0: the farthest that will be asked for.
    /// @cost O(points)
    void fill(std::span<const Point> points, double reach)
    {
        scale_ = 1.0 / (1.001 * reach); // a little more, for what is rounded
        while (shift_ > 32 && std::size_t{1} << (64 - shift_) < 2 * points.size()) --shift_;
        begins_.assign((std::size_t{1} << (64 - shift_)) + 1, 0);
        cubes_.resize(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            cubes_[i] = key(cube_of(points[i]));
            ++begins_[slot(cubes_[i])];
        }
        for (std::size_t s = 1; s < begins_.size(); ++s) begins_[s] += begins_[s - 1]; // where slots end, so far
        held_.resize(points.size());
        for (std::size_t i = points.size(); i-- > 0;)
            held_[--begins_[slot(cubes_[i])]] = {points[i], cubes_[i], static_cast<std::uint32_t>(i)};
    }

    /// Calls visit(i, squared distance) for all of the first `limit` points that are nearer than the reach, and for some
    /// that are not.
    template <class Visit>
    void near(const Point& place, std::size_t limit, const Visit& visit) const
    {
        const Cube middle = cube_of(place);
        for (std::uint64_t z = middle[2] - 1; z != middle[2] + 2; ++z)
            for (std::uint64_t y = middle[1] - 1; y != middle[1] + 2; ++y)
                for (std::uint64_t x = middle[0] - 1; x != middle[0] + 2; ++x) {
                    const std::uint64_t cube = key({x, y, z}), s = slot(cube);
                    for (std::size_t i = begins_[s]; i < begins_[s + 1] && held_[i].index < limit; ++i)
                        if (held_[i].cube == cube) visit(held_[i].index, squared_gap(place, held_[i].point));
                }
    }

private:
    using Cube = std::array<std::uint64_t, 3>;

    struct Held {
        Point point;
        std::uint64_t cube;
        std::uint32_t index; ///< rises within a slot
    };

    Cube cube_of(const Point& p) const
    {
        constexpr double most = 1e15;
        Cube cube;
        for (std::size_t c = 0; c < 3; ++c)
            cube[c] = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::min((p[c] - low_[c]) * scale_, most)));
        return cube;
    }
    /// Cubes far apart may share a key; neighbours never do.
    static std::uint64_t key(const Cube& cube)
    {
        constexpr std::uint64_t mask = (1u << 21) - 1;
        return (cube[0] & mask) | (cube[1] & mask) << 21 | (cube[2] & mask) << 42;
    }
    /// Cubes in a row stand side by side: those around a place are in nine parts of memory, not in 27.
    std::size_t slot(std::uint64_t key) const
    {
        const std::uint64_t x = key & ((1u << 21) - 1), row = (key >> 21) * 0x9e3779b97f4a7c15u >> shift_;
        return static_cast<std::size_t>((row + x) & (begins_.size() - 2));
    }

    Point low_;
    double scale_ = 1.0;
    int shift_ = 60;                    ///< the hash keeps the bits above
    std::vector<std::uint32_t> begins_; ///< [slots + 1] places in held_
    std::vector<std::uint64_t> cubes_;
    std::vector<Held> held_;
};

} // namespace meshreel
