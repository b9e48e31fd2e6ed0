/// Largest distance by branch and bound over a tree of boxes.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/diameter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace meshreel {

namespace {

using Point = std::array<double, 3>;

constexpr std::uint32_t diameter_leaf = 8;

double square_between(const Point& a, const Point& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

struct Box {
    Point low, high;

    explicit Box(std::span<const Point> points) : low(points.front()), high(points.front())
    {
        for (const Point& p : points)
            for (std::size_t i = 0; i < 3; ++i) {
                low[i] = std::min(low[i], p[i]);
                high[i] = std::max(high[i], p[i]);
            }
    }
    std::size_t longest_axis() const
    {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (high[i] - low[i] > high[longest] - low[longest]) longest = i;
        return longest;
    }
    double size() const { return square_between(low, high); }
};

/// Not below the computed squared distance of any two points of the boxes: subtraction, square and sum all round
/// monotonically, so no allowance for rounding is needed.
double bound(const Box& a, const Box& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double d = std::max(std::abs(a.high[i] - b.low[i]), std::abs(b.high[i] - a.low[i]));
        sum += d * d;
    }
    return sum;
}

class Search {
public:
    explicit Search(std::vector<Point> points) : points_(std::move(points)) {}

    double run()
    {
        walk_to_a_far_pair();
        drop_inner_points();
        if (points_.size() < 2) return std::sqrt(best_);
        build(0, static_cast<std::uint32_t>(points_.size()));
        compare(0, 0);
        return std::sqrt(best_);
    }

private:
    struct Node {
        Box box;
        std::uint32_t first, last;         // points
        std::uint32_t left = 0, right = 0; // nodes; 0: a leaf
        bool leaf() const { return left == 0; }
    };

    /// From the farthest point to the farthest point from there, as long as it gets farther: a good first guess.
    void walk_to_a_far_pair()
    {
        Point from = points_.front();
        for (double before = -1.0; best_ > before;) {
            before = best_;
            const Point start = from;
            for (const Point& p : points_)
                if (square_between(start, p) > best_) {
                    best_ = square_between(start, p);
                    from = p;
                }
        }
    }

    void drop_inner_points()
    {
        const Box all(points_);
        const auto inner = [&](const Point& p) { return bound(Box({&p, 1}), all) <= best_; };
        points_.erase(std::remove_if(points_.begin(), points_.end(), inner), points_.end());
    }

    std::uint32_t build(std::uint32_t first, std::uint32_t last)
    {
        const auto node = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({Box({points_.data() + first, last - first}), first, last});
        if (last - first <= diameter_leaf) return node;
        const std::size_t axis = nodes_[node].box.longest_axis();
        const std::uint32_t middle = first + (last - first) / 2;
        std::nth_element(points_.begin() + first, points_.begin() + middle, points_.begin() + last,
                         [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
        const std::uint32_t left = build(first, middle), right = build(middle, last);
        nodes_[node].left = left;
        nodes_[node].right = right;
        return node;
    }

    void compare(std::uint32_t a, std::uint32_t b)
    {
        const Node &na = nodes_[a], &nb = nodes_[b];
        if (bound(na.box, nb.box) <= best_) return;
        if (na.leaf() && nb.leaf()) return compare_points(na, nb);
        if (a == b) {
            compare(na.left, na.right);
            compare(na.left, na.left);
            compare(na.right, na.right);
            return;
        }
        const bool split_a = nb.leaf() || (!na.leaf() && na.box.size() >= nb.box.size());
        const Node& split = split_a ? na : nb;
        const std::uint32_t other = split_a ? b : a;
        const bool left_first =
            bound(nodes_[split.left].box, nodes_[other].box) >= bound(nodes_[split.right].box, nodes_[other].box);
        compare(left_first ? split.left : split.right, other);
        compare(left_first ? split.right : split.left, other);
    }

    void compare_points(const Node& a, const Node& b)
    {
        for (std::uint32_t i = a.first; i < a.last; ++i) {
            if (bound(Box({&points_[i], 1}), b.box) <= best_) continue;
            for (std::uint32_t j = b.first; j < b.last; ++j)
                best_ = std::max(best_, square_between(points_[i], points_[j]));
        }
    }

    std::vector<Point> points_;
    std::vector<Node> nodes_;
    double best_ = 0.0; // squared
};

template <class T>
double measured(MatrixView<const T> points)
{
    if (points.rows < 2) return 0.0;
    std::vector<Point> copy(points.rows);
    for (std::size_t i = 0; i < points.rows; ++i) copy[i] = {points(i, 0), points(i, 1), points(i, 2)};
    return Search(std::move(copy)).run();
}

} // namespace

double largest_distance(MatrixView<const float> points)
{
    return measured(points);
}
double largest_distance(MatrixView<const double> points)
{
    return measured(points);
}

} // namespace meshreel
