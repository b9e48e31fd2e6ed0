/// Pieces of triangles in a heap, the one that may reach farthest on top.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/surface_bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace meshreel::metrics {

namespace {

using Place = SurfaceDistance::Place;

constexpr std::size_t most_piece_corners = 5;
constexpr unsigned cuts_between_halvings = 4; ///< every so many cuts a piece is cut across, whatever its triangles are

/// A corner of a piece: exactly how far it is, squared, and from which triangle.
struct PieceCorner {
    Point point;
    double squared;
    Place nearest;
};

/// A convex part of a triangle.
struct Piece {
    std::array<PieceCorner, most_piece_corners> corners;
    std::size_t count = 0;
    unsigned depth = 0;
    Place common = 0;   ///< the triangle that bounds it
    double upper = 0.0; ///< no point of it is farther from `common`, squared

    void add(const PieceCorner& corner) { corners[count++] = corner; }
};

struct CutPlane {
    Point point, normal;

    double height(const Point& p) const { return dot(normal, minus(p, point)); }
};

/// The unit vector that leads from the line a b to c at a right angle; 0 where there is none.
Point away_from_line(const Point& a, const Point& b, const Point& c)
{
    const Point along = minus(b, a), to = minus(c, a);
    const double length = dot(along, along);
    if (length <= 0) return {};
    const Point across = minus(to, times(dot(to, along) / length, along));
    const double square = dot(across, across);
    return square > 0 ? times(1 / std::sqrt(square), across) : Point{};
}

/// The plane through the side that two triangles share, half way between them.
///
///          /|
///     t   / | other        as far from one as from the other
///        /  |
std::optional<CutPlane> plane_between_neighbours(const TriangleCorners& t, const TriangleCorners& other)
{
    std::array<std::size_t, 3> twin{3, 3, 3}; // of t's corners
    for (std::size_t i = 0; i < 3; ++i)
        twin[i] = static_cast<std::size_t>(std::ranges::find(other, t[i]) - other.begin());
    const auto alone = std::ranges::find(twin, std::size_t{3});
    if (std::ranges::count(twin, std::size_t{3}) != 1) return std::nullopt;
    const auto i = static_cast<std::size_t>(alone - twin.begin());
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (twin[j] == twin[k]) return std::nullopt;
    const Point& tip = other[3 - twin[j] - twin[k]];
    const Point normal = minus(away_from_line(t[j], t[k], tip), away_from_line(t[j], t[k], t[i]));
    return CutPlane{t[j], normal};
}

/// The plane half way between the points of two triangles that are nearest to a point.
CutPlane plane_between_nearest(const Point& point, const TriangleCorners& t, const TriangleCorners& other)
{
    const Point a = nearest_point(point, t), b = nearest_point(point, other);
    return {between(a, b, 0.5), minus(b, a)};
}

CutPlane plane_across_longest_side(const Piece& piece)
{
    CutPlane plane{};
    double longest = -1;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point &a = piece.corners[i].point, &b = piece.corners[(i + 1) % piece.count].point;
        const double length = squared_distance(a, b);
        if (length <= longest) continue;
        longest = length;
        plane = {between(a, b, 0.5), minus(b, a)};
    }
    return plane;
}

class BoundSearch {
public:
    BoundSearch(const SurfaceFrame& from, const SurfaceDistance& to, const BoundOptions& options)
        : from_(from), to_(to), options_(options), vertices_(from.positions.size() / 3, {{}, -1.0, 0})
    {
    }

    DistanceBounds run()
    {
        bound_triangles();
        while (!heap_.empty() && heap_.front().upper > limit_ && cuts_ < options_.most_cuts) {
            const Piece piece = take();
            if (piece.upper <= limit_ || (!heap_.empty() && piece.upper < heap_.front().upper))
                keep(piece);
            else
                cut(piece);
        }
        if (!options_.vertices.empty()) fill_vertices();
        if (!heap_.empty()) settled_ = std::max(settled_, heap_.front().upper);
        return {std::sqrt(lower_), std::sqrt(std::max(settled_, lower_)), cuts_};
    }

private:
    /// A triangle of `from` that was not looked at closely yet, or a piece.
    struct Entry {
        double upper;
        std::uint32_t index; ///< a place of from_.tree, or their number + an index into pieces_

        bool operator<(const Entry& other) const
        {
            return upper != other.upper ? upper < other.upper : index > other.index;
        }
    };

    void raise(double squared)
    {
        if (squared < lower_) return;
        lower_ = squared;
        const double limit = std::sqrt(squared) + options_.tolerance;
        limit_ = options_.tolerance > 0 ? limit * limit : squared;
    }

    PieceCorner corner(const Point& point, Place guess)
    {
        const SurfaceDistance::Nearest nearest = to_.nearest(point, guess);
        raise(nearest.squared);
        return {point, nearest.squared, nearest.place};
    }

    const PieceCorner& vertex(std::uint32_t v, Place guess)
    {
        const std::span<const float> x = from_.positions;
        if (vertices_[v].squared < 0) vertices_[v] = corner({x[3ul * v], x[3ul * v + 1], x[3ul * v + 2]}, guess);
        return vertices_[v];
    }

    /// First bounds: from the triangle of the same number, or from the one that is nearest to the middle.
    void bound_triangles()
    {
        raise(0);
        heap_.resize(from_.tree.size());
        commons_.resize(heap_.size());
        Place nearest = 0;
        for (Place place = 0; place < heap_.size(); ++place) {
            const TriangleCorners corners = from_.tree.corners(place);
            if (options_.same_triangles)
                nearest = to_.place_of(from_.tree.triangle_at(place));
            else
                nearest = corner(times(1.0 / 3, plus(corners[0], plus(corners[1], corners[2]))), nearest).nearest;
            const TriangleCorners common = to_.corners(nearest);
            double upper = 0;
            for (const Point& p : corners) upper = std::max(upper, squared_distance_to_triangle(p, common));
            heap_[place] = {upper, place};
            commons_[place] = nearest;
        }
        std::make_heap(heap_.begin(), heap_.end());
    }

    /// The piece on top of the heap, its bounds as tight as its corners make them.
    Piece take()
    {
        std::pop_heap(heap_.begin(), heap_.end());
        const Entry entry = heap_.back();
        heap_.pop_back();
        if (entry.index >= from_.tree.size()) {
            const std::size_t index = entry.index - from_.tree.size();
            free_.push_back(static_cast<std::uint32_t>(index));
            return pieces_[index];
        }
        Piece piece;
        piece.common = commons_[entry.index];
        for (const std::uint32_t v : from_.triangles[from_.tree.triangle_at(entry.index)])
            piece.add(vertex(v, piece.common));
        piece.upper = entry.upper;
        bound(piece);
        return piece;
    }

    void keep(const Piece& piece)
    {
        if (piece.upper <= limit_) {
            settled_ = std::max(settled_, piece.upper);
            return;
        }
        if (free_.empty()) {
            free_.push_back(static_cast<std::uint32_t>(pieces_.size()));
            pieces_.emplace_back();
        }
        pieces_[free_.back()] = piece;
        heap_.push_back({piece.upper, static_cast<std::uint32_t>(from_.tree.size()) + free_.back()});
        free_.pop_back();
        std::push_heap(heap_.begin(), heap_.end());
    }

    /// How far the farthest corner is from a triangle; more than `enough` need not be exact.
    double farthest(const Piece& piece, Place t, double enough) const
    {
        const TriangleCorners corners = to_.corners(t);
        double squared = 0;
        for (std::size_t i = 0; i < piece.count && squared < enough; ++i) {
            const PieceCorner& corner = piece.corners[i];
            squared = std::max(squared, corner.nearest == t ? corner.squared
                                                            : squared_distance_to_triangle(corner.point, corners));
        }
        return squared;
    }

    /// Looks for a triangle that bounds the piece better than its common one.
    void bound(Piece& piece) const
    {
        for (std::size_t i = 0; i < piece.count; ++i) {
            const Place t = piece.corners[i].nearest;
            const double upper = farthest(piece, t, piece.upper);
            if (upper >= piece.upper) continue;
            piece.upper = upper;
            piece.common = t;
        }
    }

    CutPlane plane_for(const Piece& piece) const
    {
        if (piece.depth % cuts_between_halvings == cuts_between_halvings - 1) return plane_across_longest_side(piece);
        const TriangleCorners common = to_.corners(piece.common);
        const auto end = piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.count);
        const auto worst = std::ranges::max_element(piece.corners.begin(), end, {}, [&](const PieceCorner& corner) {
            return squared_distance_to_triangle(corner.point, common);
        });
        const TriangleCorners other = to_.corners(worst->nearest);
        const auto plane = plane_between_neighbours(common, other);
        return plane ? *plane : plane_between_nearest(worst->point, common, other);
    }

    void cut(const Piece& piece)
    {
        ++cuts_;
        if (piece.count == most_piece_corners) return cut_along_diagonal(piece);
        if (!cut_along(piece, plane_for(piece)) && !cut_along(piece, plane_across_longest_side(piece)))
            settled_ = std::max(settled_, piece.upper); // as small as numbers can say
    }

    void cut_along_diagonal(const Piece& piece)
    {
        Piece one = begin_part(piece), two = begin_part(piece);
        for (std::size_t i = 0; i <= 2; ++i) one.add(piece.corners[i]);
        for (std::size_t i = 2; i <= piece.count; ++i) two.add(piece.corners[i % piece.count]);
        finish_part(one);
        finish_part(two);
    }

    /// False where the plane does not lie between the corners.
    bool cut_along(const Piece& piece, const CutPlane& plane)
    {
        std::array<double, most_piece_corners> heights;
        double lowest = 0, highest = 0;
        for (std::size_t i = 0; i < piece.count; ++i) {
            heights[i] = plane.height(piece.corners[i].point);
            lowest = std::min(lowest, heights[i]);
            highest = std::max(highest, heights[i]);
        }
        if (std::min(-lowest, highest) <= 1e-9 * std::max(-lowest, highest)) return false;
        Piece below = begin_part(piece), above = begin_part(piece);
        for (std::size_t i = 0; i < piece.count; ++i) {
            const std::size_t j = (i + 1) % piece.count;
            const PieceCorner &a = piece.corners[i], &b = piece.corners[j];
            if (heights[i] <= 0) below.add(a);
            if (heights[i] >= 0) above.add(a);
            if (heights[i] * heights[j] >= 0) continue;
            const PieceCorner crossing =
                corner(between(a.point, b.point, heights[i] / (heights[i] - heights[j])), a.nearest);
            below.add(crossing);
            above.add(crossing);
        }
        finish_part(below);
        finish_part(above);
        return true;
    }

    static Piece begin_part(const Piece& whole)
    {
        Piece part;
        part.depth = whole.depth + 1;
        part.common = whole.common;
        part.upper = whole.upper;
        return part;
    }

    void finish_part(Piece& part)
    {
        part.upper = std::min(part.upper, farthest(part, part.common, part.upper));
        bound(part);
        keep(part);
    }

    void fill_vertices()
    {
        Place guess = 0;
        for (std::uint32_t v = 0; v < options_.vertices.size(); ++v) {
            const std::span<const float> x = from_.positions.subspan(3ul * v, 3);
            if (vertices_[v].squared < 0) {
                const auto [squared, place] = to_.nearest({x[0], x[1], x[2]}, guess); // maybe no part of the surface
                vertices_[v] = {{}, squared, place};
            }
            guess = vertices_[v].nearest;
            options_.vertices[v] = std::sqrt(vertices_[v].squared);
        }
    }

    const SurfaceFrame& from_;
    const SurfaceDistance& to_;
    const BoundOptions& options_;
    std::vector<PieceCorner> vertices_; ///< [V] the distances known so far; < 0: not yet
    std::vector<Place> commons_;        ///< [T] what bounds the whole triangles
    std::vector<Entry> heap_;
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> free_;
    double lower_ = 0.0, limit_ = 0.0, settled_ = 0.0; ///< squared; what is below the limit need not be looked at
    std::size_t cuts_ = 0;
};

} // namespace

DistanceBounds bound_distance(const SurfaceFrame& from, const SurfaceDistance& to, const BoundOptions& options)
{
    return BoundSearch(from, to, options).run();
}

} // namespace meshreel::metrics
