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
    void fill(std::span<const Point> points, double reach);

    /// Points found near a place.
    struct Found {
        std::size_t count = 0;
        std::vector<double> squares; ///< [count and more] squared distances
        std::vector<std::uint32_t> points;

        /// Puts the nearest into `nearest`, in order, of equally near ones those of smaller numbers first.
        /// @return how many there are, at most its size.
        std::size_t sorted(std::span<std::uint32_t> nearest) const;
    };
    /// Of the first `limit` points those whose squared distance is at most bound <= reach^2, in no order.
    void near(const Point& place, std::size_t limit, double bound, Found& found) const;

private:
    static constexpr std::size_t block = 8;

    using Cube = std::array<std::uint64_t, 3>;
    using Squares = std::array<double, block>;

    struct Placed {
        std::uint64_t row;
        std::uint32_t slot;
    };
    struct Held {
        std::uint64_t row;
        std::uint32_t index;
    };
    struct Search {
        const Point& place;
        std::uint64_t row;
        std::size_t limit;
        double bound;
    };

    Cube cube_of(const Point& p) const
    {
        constexpr double most = 1e15;
        Cube cube;
        for (std::size_t c = 0; c < 3; ++c)
            cube[c] = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::min((p[c] - low_[c]) * scale_, most)));
        return cube;
    }
    /// Rows far apart may share a number; neighbours never do.
    static std::uint64_t row_of(std::uint64_t y, std::uint64_t z)
    {
        constexpr std::uint64_t mask = (std::uint64_t{1} << 32) - 1;
        return (y & mask) | z << 32;
    }
    /// Cubes in a row stand side by side: those around a place are in nine parts of memory, not in 27.
    std::size_t slot(std::uint64_t row, std::uint64_t x) const
    {
        return static_cast<std::size_t>(((row * 0x9e3779b97f4a7c15u >> shift_) + x) & (begins_.size() - 2));
    }
    void look(const Search& search, std::size_t begin, std::size_t end, Found& found) const;
    /// Squared distances of the points held from `begin` on.
    Squares squares_from(std::size_t begin, const Point& place) const;

    Point low_;
    double scale_ = 1.0;
    int shift_ = 60;                        ///< the hash keeps the bits above
    std::vector<std::uint32_t> begins_;     ///< [slots + 1] places in held_
    std::vector<Placed> cubes_;             ///< [points]
    std::vector<Held> held_;                ///< slot after slot
    std::array<std::vector<double>, 3> at_; ///< [points held, and as many as fill a block] their coordinates
};

} // namespace meshreel
