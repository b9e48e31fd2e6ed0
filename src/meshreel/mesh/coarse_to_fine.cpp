/// Greedy levels: a point taken tells all within the spacing how near it is, and finds its own neighbours in a grid.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "meshreel/mesh/cells.h"

namespace meshreel {

namespace {

constexpr std::size_t level_count = 160; // 1.1^160 is 4 million

std::vector<Point> finite_points(MatrixView<const double> X)
{
    std::vector<Point> points(X.rows);
    for (std::size_t i = 0; i < X.rows; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = X(i, c);
            points[i][c] = x > -1e100 && x < 1e100 ? x : 0.0;
        }
    return points;
}

struct Bounds {
    Point low, high;
};

Bounds bounds_of(const std::vector<Point>& points)
{
    Bounds bounds{points.front(), points.front()};
    for (const Point& p : points)
        for (std::size_t c = 0; c < 3; ++c) {
            bounds.low[c] = std::min(bounds.low[c], p[c]);
            bounds.high[c] = std::max(bounds.high[c], p[c]);
        }
    return bounds;
}

/// Squared distances that the points of each level keep, [level_count]; the last is 0.
std::vector<double> squared_spacings(const Bounds& bounds)
{
    std::vector<double> squares(level_count);
    double square = 0.25 * squared_gap(bounds.low, bounds.high);
    for (double& s : squares) {
        s = square;
        square = square / 1.21;
    }
    squares.back() = 0.0;
    return squares;
}

/// Puts every point into its level.
class SpacedLevels {
public:
    SpacedLevels(const std::vector<Point>& points, const Bounds& bounds)
        : points_(points), squares_(squared_spacings(bounds)), waiting_(level_count),
          nearest_(points.size(), std::numeric_limits<double>::infinity()), cells_(bounds.low)
    {
        waiting_[0].resize(points.size());
        std::iota(waiting_[0].begin(), waiting_[0].end(), 0u);
        left_ = waiting_[0];
    }

    /// Appends the points of a level to the order. A point waits for the level whose spacing has come down to its distance
    /// to those taken.
    void take(std::size_t l, CoarseToFine& result)
    {
        std::ranges::sort(waiting_[l]);
        for (const std::uint32_t point : waiting_[l]) {
            std::size_t level = l;
            while (nearest_[point] < squares_[level]) ++level;
            if (level > l) {
                waiting_[level].push_back(point);
                continue;
            }
            result.order.push_back(point);
            nearest_[point] = -1.0;
            cover(points_[point], squares_[l]);
        }
        waiting_[l] = {};
        result.ends.push_back(result.order.size());
    }

    /// How far apart the points of a level and of those before are, at least.
    double spacing(std::size_t l) const { return std::sqrt(squares_[l]); }

private:
    /// Tells all points within the spacing how near they are to one that is taken.
    void cover(const Point& taken, double squared_spacing)
    {
        if (!(squared_spacing > 0)) return;
        if (squared_spacing < 0.6 * squared_reach_) gather(squared_spacing);
        cells_.near(taken, left_.size(), squared_spacing, found_);
        for (std::size_t i = 0; i < found_.count; ++i) {
            double& nearest = nearest_[left_[found_.points[i]]];
            nearest = std::min(nearest, found_.squares[i]);
        }
    }

    /// Sorts the points that are not taken into a finer grid.
    void gather(double squared_reach)
    {
        std::erase_if(left_, [&](std::uint32_t point) { return nearest_[point] < 0; });
        std::vector<Point> points(left_.size());
        for (std::size_t i = 0; i < left_.size(); ++i) points[i] = points_[left_[i]];
        cells_.fill(points, std::sqrt(squared_reach));
        squared_reach_ = squared_reach;
    }

    const std::vector<Point>& points_;
    std::vector<double> squares_;
    std::vector<std::vector<std::uint32_t>> waiting_; ///< [level_count]
    std::vector<double> nearest_;                     ///< [N] squared distance to those taken, -1 of those themselves
    std::vector<std::uint32_t> left_;                 ///< in the grid
    Cells cells_;
    Cells::Found found_;
    double squared_reach_ = std::numeric_limits<double>::infinity(); ///< of the grid
};

/// Finds the neighbours of all points, a few levels at a time, from fine to coarse: whoever has too few within reach asks
/// again in the next, wider grid.
class Neighbours {
public:
    Neighbours(const std::vector<Point>& points, const Bounds& bounds, CoarseToFine& result)
        : result_(result), cells_(bounds.low), diagonal_(std::sqrt(squared_gap(bounds.low, bounds.high)))
    {
        for (const std::uint32_t point : result.order) ordered_.push_back(points[point]);
        for (std::size_t l = 0; l < result.ends.size(); ++l)
            limits_.resize(result.ends[l], l == 0 ? 0u : static_cast<std::uint32_t>(result.ends[l - 1]));
    }

    void find(const SpacedLevels& levels, Threads threads)
    {
        constexpr std::size_t step = 2;
        const double wanted = std::sqrt(static_cast<double>(result_.nearest.cols)); // spacings; enough on a surface
        for (std::size_t end = result_.ends.size(); end > 0; end = (end - 1) / step * step) {
            const std::size_t l = (end - 1) / step * step; // the first of these levels
            for (std::size_t place = l == 0 ? 0 : result_.ends[l - 1]; place < result_.ends[end - 1]; ++place)
                pending_.push_back(static_cast<std::uint32_t>(place));
            const double reach = l == 0 ? 1.001 * diagonal_ : wanted * levels.spacing(l - 1);
            if (reach > 0 && !pending_.empty()) look(reach, threads);
        }
    }

private:
    static constexpr std::uint32_t done = CoarseToFine::nobody;

    /// Those who are pending and find enough, or all, are done.
    void look(double reach, Threads threads)
    {
        cells_.fill(std::span(ordered_).first(limits_[*std::max_element(pending_.begin(), pending_.end())]), reach);
        constexpr std::size_t block = 128;
        parallel_for((pending_.size() + block - 1) / block, threads, [&](std::size_t task) {
            Cells::Found near;
            for (std::size_t i = task * block; i < std::min(pending_.size(), (task + 1) * block); ++i) {
                const std::uint32_t place = pending_[i];
                const std::span<std::uint32_t> row = result_.nearest.row(result_.order[place]);
                cells_.near(ordered_[place], limits_[place], reach * reach, near);
                const std::size_t found = near.sorted(row);
                if (found < row.size() && reach < diagonal_) continue;
                for (std::uint32_t& other : row.first(found)) other = result_.order[other];
                pending_[i] = done;
            }
        });
        std::erase(pending_, done);
    }

    CoarseToFine& result_;
    Cells cells_;
    double diagonal_;
    std::vector<Point> ordered_;         ///< [N] in the order
    std::vector<std::uint32_t> limits_;  ///< [N] how many points of the order are of earlier levels
    std::vector<std::uint32_t> pending_; ///< places in the order
};

} // namespace

CoarseToFine coarse_to_fine(MatrixView<const double> X, std::size_t n, Threads threads)
{
    CoarseToFine result;
    result.nearest = Matrix<std::uint32_t>(X.rows, n);
    std::fill(result.nearest.values.begin(), result.nearest.values.end(), CoarseToFine::nobody);
    if (X.rows == 0) return result;
    const std::vector<Point> points = finite_points(X);
    const Bounds bounds = bounds_of(points);
    SpacedLevels levels(points, bounds);
    result.order.reserve(X.rows);
    for (std::size_t l = 0; l < level_count; ++l) levels.take(l, result);
    Neighbours(points, bounds, result).find(levels, threads);
    return result;
}

} // namespace meshreel
