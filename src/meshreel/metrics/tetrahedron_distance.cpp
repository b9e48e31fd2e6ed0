/// Corners and edges first; a face only where the point projects onto two of its edges, the inside only where onto a face.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/tetrahedron_distance.h"

#include <algorithm>
#include <cstddef>

namespace meshreel::metrics {

namespace {

/// By how much a projection may miss a feature and still count as on it, when deciding what else is looked at.
constexpr double projection_slack = 1e-9;
/// Gram determinants below this part of the product of their diagonal are of features without a size.
constexpr double flat_face = 1e-14, flat_inside = 1e-20;
/// From here on a determinant is good to ten digits, and what is that far beyond a bound is beyond it.
constexpr double sound_inside = 1e-6, rounding_slack = 1e-8;

constexpr std::size_t edge_from[6] = {0, 0, 0, 1, 1, 2}, edge_to[6] = {1, 2, 3, 2, 3, 3};
struct FaceEdges {
    std::size_t first, second, third; ///< edges; the first two leave the same corner
};
constexpr FaceEdges face_edges[4] = {{0, 1, 3}, {0, 2, 4}, {1, 2, 5}, {3, 4, 5}};

/// a - s b
Point4 less(const Point4& a, double s, const Point4& b)
{
    return {a[0] - s * b[0], a[1] - s * b[1], a[2] - s * b[2], a[3] - s * b[3]};
}

class TetrahedronProbe {
public:
    TetrahedronProbe(const Point4& point, const std::array<Point4, 4>& corners) : corners_(corners)
    {
        for (std::size_t i = 0; i < 4; ++i) {
            from_[i] = point - corners[i];
            const double squared = dot(from_[i], from_[i]);
            if (i > 0 && squared >= best_) continue;
            best_ = squared;
            nearest_ = i;
        }
    }

    /// Whether all corners are at least so far in the direction of the nearest one: most tetrahedra that are far are.
    bool behind_plane(double bound) const
    {
        double least = best_;
        for (std::size_t i = 0; i < 4; ++i) least = std::min(least, dot(from_[i], from_[nearest_]));
        return least > 0.0 && least * least * (1.0 - rounding_slack) >= bound * best_;
    }

    /// What the tests below need.
    void prepare()
    {
        for (std::size_t k = 0; k < 3; ++k) take_edge(k);
        const Point4 &u = edge_[0], &v = edge_[1], &w = edge_[2];
        const double uu = length_[0], vv = length_[1], ww = length_[2];
        const double uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
        inverse_ = {vv * ww - vw * vw, uw * vw - uv * ww, uv * vw - uw * vv,
                    uu * ww - uw * uw, uv * uw - uu * vw, uu * vv - uv * uv};
        box_ = uu * vv * ww;
        volume_ = uu * inverse_[0] + uv * inverse_[1] + uw * inverse_[2];
    }

    /// Whether the point is at least so far: from the hyperplane, and beside one of the four faces within it.
    bool beyond(double bound) const
    {
        if (!(volume_ > sound_inside * box_)) return false;
        const auto [a, b, c] = weights(along_[0], along_[1], along_[2]);
        const Point4 rest = less(less(less(from_[0], a, edge_[0]), b, edge_[1]), c, edge_[2]);
        const double d = 1.0 - (a + b + c);
        const double all = inverse_[0] + inverse_[3] + inverse_[5] + 2 * (inverse_[1] + inverse_[2] + inverse_[4]);
        // A weight below 0, times the altitude that it is measured along: how far the point is beyond that face.
        const auto beside = [&](double weight, double inverse) {
            return weight < 0.0 ? weight * weight * volume_ / inverse : 0.0;
        };
        const double in_plane = std::max(std::max(beside(a, inverse_[0]), beside(b, inverse_[3])),
                                         std::max(beside(c, inverse_[5]), beside(d, all)));
        return (dot(rest, rest) + in_plane) * (1.0 - rounding_slack) -
                   rounding_slack * rounding_slack * dot(from_[0], from_[0]) >=
               bound;
    }

    double squared()
    {
        for (std::size_t k = 3; k < 6; ++k) take_edge(k);
        for (std::size_t k = 0; k < 6; ++k) look_at_edge(k);
        bool on_face = false;
        for (const FaceEdges& face : face_edges)
            if (on_edge_[face.first] + on_edge_[face.second] + on_edge_[face.third] >= 2) on_face |= look_at_face(face);
        if (on_face) look_inside();
        return best_;
    }

private:
    void take_edge(std::size_t k)
    {
        edge_[k] = corners_[edge_to[k]] - corners_[edge_from[k]];
        length_[k] = dot(edge_[k], edge_[k]);
        along_[k] = dot(from_[edge_from[k]], edge_[k]);
    }

    /// What of the first three edges leads to a point, from its projections onto them.
    std::array<double, 3> weights(double ru, double rv, double rw) const
    {
        return {(inverse_[0] * ru + inverse_[1] * rv + inverse_[2] * rw) / volume_,
                (inverse_[1] * ru + inverse_[3] * rv + inverse_[4] * rw) / volume_,
                (inverse_[2] * ru + inverse_[4] * rv + inverse_[5] * rw) / volume_};
    }

    void offer(const Point4& rest) { best_ = std::min(best_, dot(rest, rest)); }

    void look_at_edge(std::size_t k)
    {
        const double slack = projection_slack * length_[k];
        on_edge_[k] = along_[k] >= -slack && along_[k] <= length_[k] + slack;
        if (along_[k] > 0.0 && along_[k] < length_[k])
            offer(less(from_[edge_from[k]], along_[k] / length_[k], edge_[k]));
    }

    /// Whether the point projects onto the face, or might: the face has no area.
    bool look_at_face(const FaceEdges& face)
    {
        const Point4 &u = edge_[face.first], &v = edge_[face.second], &from = from_[edge_from[face.first]];
        const double uu = length_[face.first], vv = length_[face.second], uv = dot(u, v), area = uu * vv - uv * uv;
        if (!(area > flat_face * (uu * vv))) return true;
        const auto solve = [&](double ru, double rv) {
            return std::array{(vv * ru - uv * rv) / area, (uu * rv - uv * ru) / area};
        };
        auto [a, b] = solve(along_[face.first], along_[face.second]);
        if (a < -projection_slack || b < -projection_slack || a + b > 1.0 + projection_slack) return false;
        if (a < 0.0 || b < 0.0 || a + b > 1.0) return true;
        const Point4 rest = less(less(from, a, u), b, v);
        offer(rest);
        const auto [da, db] = solve(dot(rest, u), dot(rest, v)); // what rounding left
        if (a + da >= 0.0 && b + db >= 0.0 && a + da + b + db <= 1.0) offer(less(less(rest, da, u), db, v));
        return true;
    }

    void look_inside()
    {
        if (!(volume_ > flat_inside * box_)) return;
        Point4 rest = from_[0];
        double a = 0.0, b = 0.0, c = 0.0;
        for (int round = 0; round < 2; ++round) { // the second one mends what rounding left
            const auto [da, db, dc] = weights(dot(rest, edge_[0]), dot(rest, edge_[1]), dot(rest, edge_[2]));
            a += da, b += db, c += dc;
            if (a < 0.0 || b < 0.0 || c < 0.0 || a + b + c > 1.0) return;
            rest = less(less(less(rest, da, edge_[0]), db, edge_[1]), dc, edge_[2]);
            offer(rest);
        }
    }

    const std::array<Point4, 4>& corners_;
    std::array<Point4, 4> from_; ///< the point, seen from each corner
    std::array<Point4, 6> edge_;
    std::array<double, 6> length_, along_; ///< squared; the point's projection onto the edge's line, times the length
    std::array<bool, 6> on_edge_{};
    std::array<double, 6> inverse_; ///< of the Gram matrix of the first three edges, times its determinant, volume_
    double box_, volume_;           ///< the product of its diagonal; its determinant
    double best_ = 0.0;             ///< the smallest squared distance found
    std::size_t nearest_ = 0;       ///< corner
};

} // namespace

double squared_distance_to_tetrahedron(const Point4& point, const std::array<Point4, 4>& corners, double bound)
{
    TetrahedronProbe probe(point, corners);
    if (probe.behind_plane(bound)) return bound;
    probe.prepare();
    return probe.beyond(bound) ? bound : probe.squared();
}

} // namespace meshreel::metrics
