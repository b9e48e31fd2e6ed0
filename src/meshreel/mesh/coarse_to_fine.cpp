/// Greedy levels with a k-d tree that knows which of its points are taken.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/coarse_to_fine.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace meshreel {

namespace {

using Point = std::array<double, 3>;

constexpr std::uint32_t untaken = 0xffffffff;
constexpr std::size_t level_count = 160; // 1.1^160 is 4 million
constexpr std::size_t crowd = 8;

double squared_gap(const Point& a, const Point& b)
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/// Points found so far, nearest first; of equally near ones those found first.
class NearestList {
public:
    explicit NearestList(std::size_t most) : most_(most) { found_.reserve(most); }

    /// Only nearer points are of interest.
    double bound() const { return found_.size() < most_ ? limit_ : found_.back().distance; }
    void offer(double distance, std::uint32_t point)
    {
        if (!(distance < bound())) return;
        if (found_.size() == most_) found_.pop_back();
        found_.push_back({distance, point});
        for (std::size_t i = found_.size() - 1; i > 0 && distance < found_[i - 1].distance; --i)
            std::swap(found_[i], found_[i - 1]);
    }
    void clear(double limit)
    {
        found_.clear();
        limit_ = limit;
    }
    std::size_t size() const { return found_.size(); }
    std::uint32_t point(std::size_t i) const { return found_[i].point; }
    double distance(std::size_t i) const { return found_[i].distance; }

private:
    struct Candidate {
        double distance;
        std::uint32_t point;
    };
    std::size_t most_;
    double limit_ = 0.0;
    std::vector<Candidate> found_;
};

/// A k-d tree over all points, of which only those taken can be found. Where points coincide it decides which are
/// found, so it is built the same way everywhere: halves by (coordinate, number), leaves by number.
class TakenTree {
public:
    explicit TakenTree(std::vector<Point> points)
        : points_(std::move(points)), items_(points_.size()), leaf_(points_.size())
    {
        std::iota(items_.begin(), items_.end(), 0u);
        level_at_.assign(points_.size(), untaken);
        place_.resize(points_.size());
        if (!points_.empty()) build({0, points_.size()}, nothing);
        for (std::size_t i = 0; i < items_.size(); ++i) {
            points_at_.push_back(points_[items_[i]]);
            place_[items_[i]] = static_cast<std::uint32_t>(i);
        }
    }

    void take(std::uint32_t point, std::uint32_t level)
    {
        level_at_[place_[point]] = level;
        for (std::uint32_t n = leaf_[point]; n != nothing && nodes_[n].earliest > level; n = nodes_[n].parent)
            nodes_[n].earliest = level;
    }
    std::uint32_t level(std::uint32_t point) const { return level_at_[place_[point]]; }

    /// The nearest points of levels below the limit, as far as `found` is interested.
    void search(std::uint32_t point, std::uint32_t limit, NearestList& found) const
    {
        visit(0, {points_[point], limit}, found);
    }

private:
    static constexpr std::uint32_t nothing = 0xffffffff;

    struct Range {
        std::size_t begin, end;
    };
    struct Node {
        Range items;
        Point low, high;
        std::uint32_t parent = nothing, left = nothing, right = nothing;
        std::uint32_t earliest = untaken; ///< the lowest level of a point below
    };
    struct Query {
        Point point;
        std::uint32_t limit;
    };

    std::uint32_t build(Range range, std::uint32_t parent)
    {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({range, points_[items_[range.begin]], points_[items_[range.begin]], parent});
        for (std::size_t i = range.begin; i < range.end; ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                nodes_[index].low[c] = std::min(nodes_[index].low[c], points_[items_[i]][c]);
                nodes_[index].high[c] = std::max(nodes_[index].high[c], points_[items_[i]][c]);
            }
        if (range.end - range.begin <= crowd) {
            const auto first = items_.begin() + static_cast<std::ptrdiff_t>(range.begin);
            std::sort(first, first + static_cast<std::ptrdiff_t>(range.end - range.begin));
            for (std::size_t i = range.begin; i < range.end; ++i) leaf_[items_[i]] = index;
            return index;
        }
        const std::size_t middle = split(range, nodes_[index]);
        const std::uint32_t left = build({range.begin, middle}, index), right = build({middle, range.end}, index);
        nodes_[index].left = left;
        nodes_[index].right = right;
        return index;
    }

    /// Halves a range along the longest side of its box.
    std::size_t split(Range range, const Node& node)
    {
        std::size_t axis = 0;
        for (std::size_t c = 1; c < 3; ++c)
            if (node.high[c] - node.low[c] > node.high[axis] - node.low[axis]) axis = c;
        const std::size_t middle = (range.begin + range.end) / 2;
        const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(range.begin), at(middle), at(range.end), [&](std::uint32_t a, std::uint32_t b) {
            return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
        });
        return middle;
    }

    static double distance_to_box(const Point& p, const Node& node)
    {
        double sum = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double outside = std::max(std::max(node.low[c] - p[c], p[c] - node.high[c]), 0.0);
            sum += outside * outside;
        }
        return sum;
    }

    void visit(std::uint32_t index, const Query& query, NearestList& found) const
    {
        const Node& node = nodes_[index];
        if (node.left == nothing) {
            for (std::size_t i = node.items.begin; i < node.items.end; ++i)
                if (level_at_[i] < query.limit) found.offer(squared_gap(query.point, points_at_[i]), items_[i]);
            return;
        }
        std::array<std::uint32_t, 2> child{node.left, node.right};
        std::array<double, 2> away{distance_to_box(query.point, nodes_[child[0]]),
                                   distance_to_box(query.point, nodes_[child[1]])};
        if (away[1] < away[0]) {
            std::swap(child[0], child[1]);
            std::swap(away[0], away[1]);
        }
        for (std::size_t i = 0; i < 2; ++i)
            if (nodes_[child[i]].earliest < query.limit && away[i] < found.bound()) visit(child[i], query, found);
    }

    std::vector<Point> points_, points_at_;       ///< by number, by place in the tree
    std::vector<std::uint32_t> items_, level_at_; ///< by place
    std::vector<std::uint32_t> leaf_, place_;     ///< by number
    std::vector<Node> nodes_;
};

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

/// Squared distances that the points of each level keep, [level_count]; the last is 0.
std::vector<double> squared_spacings(const std::vector<Point>& points)
{
    Point low = points.front(), high = points.front();
    for (const Point& p : points)
        for (std::size_t c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], p[c]);
            high[c] = std::max(high[c], p[c]);
        }
    std::vector<double> squares(level_count);
    double square = 0.25 * squared_gap(low, high);
    for (double& s : squares) {
        s = square;
        square = square / 1.21;
    }
    squares.back() = 0.0;
    return squares;
}

/// Puts every point into its level. A point is looked at again only once the spacing has come down to its distance to
/// the points taken when it was last looked at.
void take_all(TakenTree& tree, const std::vector<double>& squares, CoarseToFine& result)
{
    std::vector<std::vector<std::uint32_t>> waiting(level_count);
    waiting[0].resize(result.nearest.rows);
    std::iota(waiting[0].begin(), waiting[0].end(), 0u);
    std::vector<double> nearest(result.nearest.rows, std::numeric_limits<double>::infinity());
    NearestList found(1);
    for (std::size_t l = 0; l < level_count; ++l) {
        std::sort(waiting[l].begin(), waiting[l].end());
        for (const std::uint32_t point : waiting[l]) {
            found.clear(nearest[point]);
            tree.search(point, untaken, found);
            if (found.size() != 0) nearest[point] = found.distance(0);
            std::size_t level = l;
            while (nearest[point] < squares[level]) ++level;
            if (level > l) {
                waiting[level].push_back(point);
                continue;
            }
            tree.take(point, static_cast<std::uint32_t>(l));
            result.order.push_back(point);
        }
        result.ends.push_back(result.order.size());
        waiting[l] = {};
    }
}

} // namespace

CoarseToFine coarse_to_fine(MatrixView<const double> X, std::size_t n, Threads threads)
{
    CoarseToFine result;
    result.nearest = Matrix<std::uint32_t>(X.rows, n);
    std::fill(result.nearest.values.begin(), result.nearest.values.end(), CoarseToFine::nobody);
    if (X.rows == 0) return result;
    std::vector<Point> points = finite_points(X);
    const std::vector<double> squares = squared_spacings(points);
    TakenTree tree(std::move(points));
    result.order.reserve(X.rows);
    take_all(tree, squares, result);
    constexpr std::size_t block = 256;
    parallel_for((X.rows + block - 1) / block, threads, [&](std::size_t task) {
        NearestList found(n);
        for (std::size_t p = task * block; p < std::min(X.rows, (task + 1) * block); ++p) {
            const auto point = static_cast<std::uint32_t>(p);
            found.clear(std::numeric_limits<double>::infinity());
            tree.search(point, tree.level(point), found);
            for (std::size_t i = 0; i < found.size(); ++i) result.nearest(p, i) = found.point(i);
        }
    });
    return result;
}

} // namespace meshreel
