/// The ring by chaining the edges opposite the vertex; then ear after ear.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/hole.h"

#include <algorithm>
#include <array>

namespace meshreel::connectivity {

namespace {

Edge hole_edge(std::uint32_t a, std::uint32_t b)
{
    return {std::min(a, b), std::max(a, b)};
}

/// A polygon under the knife.
class EarCutter {
public:
    EarCutter(const Stars& stars, Hole& hole) : stars_(stars), hole_(hole), size_(hole.ring.size())
    {
        for (std::size_t i = 0; i < size_; ++i)
            corners_[i] = {hole.ring[i], static_cast<std::int64_t>(stars.degree(hole.ring[i])) - 1};
    }

    /// False where an edge would be there twice.
    bool cut()
    {
        if (!hole_.closed && !make_edge(0, size_ - 1)) return false;
        while (size_ > 3) {
            const std::size_t tip = best_ear();
            if (tip == size_) return false;
            const std::size_t left = before(tip), right = after(tip);
            make_edge(left, right);
            cut_off(tip);
        }
        hole_.triangles.push_back({corners_[0].vertex, corners_[1].vertex, corners_[2].vertex});
        return true;
    }

private:
    struct Corner {
        std::uint32_t vertex;
        std::int64_t degree;
    };

    std::size_t before(std::size_t i) const { return i == 0 ? size_ - 1 : i - 1; }
    std::size_t after(std::size_t i) const { return i + 1 == size_ ? 0 : i + 1; }

    /// The place of the best tip, size_ if no place will do.
    std::size_t best_ear() const
    {
        std::size_t best = size_;
        std::int64_t most = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const Corner &tip = corners_[i], &left = corners_[before(i)], &right = corners_[after(i)];
            const std::int64_t worth = tip.degree - left.degree - right.degree; // (8.3)
            const bool better = best == size_ || worth > most || (worth == most && tip.vertex < corners_[best].vertex);
            if (!better || stars_.triangles_at(left.vertex, right.vertex) != 0) continue;
            best = i;
            most = worth;
        }
        return best;
    }

    bool make_edge(std::size_t i, std::size_t j)
    {
        Corner &a = corners_[i], &b = corners_[j];
        if (stars_.triangles_at(a.vertex, b.vertex) != 0) return false;
        hole_.claims.push_back(hole_edge(a.vertex, b.vertex));
        ++a.degree;
        ++b.degree;
        return true;
    }

    void cut_off(std::size_t tip)
    {
        hole_.triangles.push_back({corners_[before(tip)].vertex, corners_[tip].vertex, corners_[after(tip)].vertex});
        std::copy(corners_.begin() + tip + 1, corners_.begin() + size_, corners_.begin() + tip);
        --size_;
    }

    const Stars& stars_;
    Hole& hole_;
    std::size_t size_;
    std::array<Corner, largest_ring> corners_;
};

/// The neighbours of v in turn. False unless its triangles chain up into one ring or path.
bool find_ring(const Mesh& mesh, std::uint32_t v, Hole& hole)
{
    const std::span<const std::uint32_t> star = mesh.stars.triangles(v);
    const std::size_t n = star.size();
    if (n == 0 || n > largest_ring || mesh.stars.stuck(v)) return false;
    std::array<std::uint32_t, largest_ring> from, to; // the edges opposite v
    for (std::size_t i = 0; i < n; ++i) {
        const Triangle& t = mesh.triangles[star[i]];
        const std::size_t corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        from[i] = t[(corner + 1) % 3];
        to[i] = t[(corner + 2) % 3];
    }
    const auto place = [n](const auto& values, std::uint32_t value) {
        return static_cast<std::size_t>(std::find(values.begin(), values.begin() + n, value) - values.begin());
    };
    std::size_t first = 0; // an edge that no edge comes before, or any one of a ring
    for (std::size_t i = 0; i < n; ++i)
        if (place(to, from[i]) == n) first = i;
    hole.closed = place(to, from[first]) != n;
    hole.ring.clear();
    std::size_t i = first;
    for (std::size_t count = 0; count < n && i != n; ++count) {
        if (std::find(hole.ring.begin(), hole.ring.end(), from[i]) != hole.ring.end()) return false;
        hole.ring.push_back(from[i]);
        if (count + 1 == n && !hole.closed) hole.ring.push_back(to[i]);
        i = place(from, to[i]);
    }
    const bool whole = hole.ring.size() == n + (hole.closed ? 0 : 1) && i == (hole.closed ? first : n);
    if (!whole || hole.ring.size() > largest_ring || (hole.closed && n < 3)) return false;
    if (hole.closed)
        std::rotate(hole.ring.begin(), std::min_element(hole.ring.begin(), hole.ring.end()), hole.ring.end());
    return true;
}

bool has_triangle_beside(const Mesh& mesh, std::uint32_t v, const std::vector<std::uint32_t>& ring)
{
    const auto smaller = [&](std::uint32_t a, std::uint32_t b) { return mesh.stars.degree(a) < mesh.stars.degree(b); };
    const std::uint32_t least = *std::min_element(ring.begin(), ring.end(), smaller);
    const auto same = [&](std::uint32_t t) {
        const Triangle& corners = mesh.triangles[t];
        const auto in_it = [&](std::uint32_t r) {
            return std::find(corners.begin(), corners.end(), r) != corners.end();
        };
        return !in_it(v) && std::all_of(ring.begin(), ring.end(), in_it);
    };
    const std::span<const std::uint32_t> star = mesh.stars.triangles(least);
    return std::any_of(star.begin(), star.end(), same);
}

/// Two or three neighbours need no new edge. Other holes with the same ring are told by its smallest edge.
bool close_small(const Mesh& mesh, std::uint32_t v, Hole& hole)
{
    const std::vector<std::uint32_t>& ring = hole.ring;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i)
        if (mesh.stars.triangles_at(ring[i], ring[i + 1]) != 2) return false;
    if (ring.size() == 3) {
        if (mesh.stars.triangles_at(ring[2], ring[0]) != 2 || has_triangle_beside(mesh, v, ring)) return false;
        hole.triangles.push_back({ring[0], ring[1], ring[2]});
    }
    std::array<std::uint32_t, 3> sorted{};
    std::partial_sort_copy(ring.begin(), ring.end(), sorted.begin(), sorted.begin() + ring.size());
    hole.claims.push_back({sorted[0], sorted[1]});
    return true;
}

} // namespace

bool find_hole(const Mesh& mesh, std::uint32_t v, Hole& hole)
{
    hole.triangles.clear();
    hole.claims.clear();
    if (!find_ring(mesh, v, hole)) return false;
    if (hole.ring.size() == 2 || (hole.closed && hole.ring.size() == 3)) return close_small(mesh, v, hole);
    return EarCutter(mesh.stars, hole).cut();
}

} // namespace meshreel::connectivity
