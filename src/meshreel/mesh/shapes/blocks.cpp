/// Block surfaces: find the sides between full and empty, then cut each gap between planes into as many cells as fit.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/shapes/blocks.h"

#include <algorithm>
#include <map>
#include <set>

namespace meshreel::shapes {

namespace {

using Index = std::array<std::uint32_t, 3>;

/// A side of a block that faces empty space: in the plane `at` of `axis`, spanned by gap `at` of the other two axes.
struct Side {
    Index at;
    std::size_t axis;
    bool upper; ///< faces towards rising coordinates
    std::size_t u() const { return (axis + 1) % 3; }
    std::size_t v() const { return (axis + 2) % 3; }
};

std::vector<Side> outer_sides(const Blocks& blocks)
{
    const std::set<Index> filled(blocks.filled.begin(), blocks.filled.end());
    std::vector<Side> sides;
    for (const Index& block : filled)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (bool upper : {false, true}) {
                Index neighbour = block;
                neighbour[axis] += upper ? 1u : ~0u; // below 0 wraps to a block that is never filled
                if (filled.count(neighbour)) continue;
                Index at = block;
                at[axis] += upper ? 1 : 0;
                sides.push_back({at, axis, upper});
            }
    return sides;
}

/// How many cells each gap between planes is cut into.
using Cuts = std::array<std::vector<std::uint32_t>, 3>;

/// Vertices of the cut surface of a closed body of sides: by V = 2 + quads for a sphere, and so for each shared side.
class Counter {
public:
    explicit Counter(const std::vector<Side>& sides) : sides_(sides)
    {
        for (const Side& side : sides)
            for (std::uint32_t i = 0; i < 2; ++i) {
                Index across = side.at, along = side.at;
                across[side.v()] += i;
                along[side.u()] += i;
                edges_.insert({side.u(), across});
                edges_.insert({side.v(), along});
                for (std::uint32_t j = 0; j < 2; ++j) {
                    Index corner = across;
                    corner[side.u()] += j;
                    corners_.insert(corner);
                }
            }
    }
    std::uint64_t vertices(const Cuts& cuts) const
    {
        std::uint64_t count = corners_.size();
        for (const auto& [axis, at] : edges_) count += cuts[axis][at[axis]] - 1;
        for (const Side& side : sides_)
            count += std::uint64_t{cuts[side.u()][side.at[side.u()]] - 1} * (cuts[side.v()][side.at[side.v()]] - 1);
        return count;
    }

private:
    const std::vector<Side>& sides_;
    std::set<std::pair<std::size_t, Index>> edges_;
    std::set<Index> corners_;
};

/// Cuts the gap with the longest cells, again and again, as long as the vertices last.
Cuts even_cuts(const Blocks& blocks, const std::vector<Side>& sides, std::uint32_t vertices)
{
    Cuts cuts;
    for (std::size_t axis = 0; axis < 3; ++axis) cuts[axis].assign(blocks.planes[axis].size() - 1, 1);
    const Counter counter(sides);
    for (;;) {
        double longest = 0.0;
        std::uint32_t* gap = nullptr;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < cuts[axis].size(); ++i) {
                const double cell = (blocks.planes[axis][i + 1] - blocks.planes[axis][i]) / cuts[axis][i];
                if (cell <= longest) continue;
                longest = cell;
                gap = &cuts[axis][i];
            }
        ++*gap;
        if (counter.vertices(cuts) <= vertices) continue;
        --*gap;
        return cuts;
    }
}

class Builder {
public:
    Builder(const Blocks& blocks, const Cuts& cuts) : blocks_(blocks), cuts_(cuts)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first_[axis].push_back(0);
            for (std::uint32_t n : cuts[axis]) first_[axis].push_back(first_[axis].back() + n);
        }
    }

    void add(const Side& side)
    {
        const std::size_t u = side.u(), v = side.v();
        Index corner;
        for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] = first_[axis][side.at[axis]];
        for (std::uint32_t i = 0; i < cuts_[u][side.at[u]]; ++i)
            for (std::uint32_t j = 0; j < cuts_[v][side.at[v]]; ++j) {
                Index a = corner;
                a[u] += i;
                a[v] += j;
                add_cell(a, u, v, side.upper);
            }
    }

    Body body;

private:
    void add_cell(Index a, std::size_t u, std::size_t v, bool upper)
    {
        Index b = a, c = a, d = a;
        b[u] += 1;
        c[u] += 1;
        c[v] += 1;
        d[v] += 1;
        if (!upper) std::swap(b, d);
        const bool even = (a[0] + a[1] + a[2]) % 2 == 0; // diagonals alternate
        if (even) {
            body.triangles.push_back({vertex(a), vertex(b), vertex(c)});
            body.triangles.push_back({vertex(a), vertex(c), vertex(d)});
        } else {
            body.triangles.push_back({vertex(a), vertex(b), vertex(d)});
            body.triangles.push_back({vertex(b), vertex(c), vertex(d)});
        }
    }

    std::uint32_t vertex(const Index& at)
    {
        const auto [found, is_new] = numbers_.insert({at, static_cast<std::uint32_t>(body.points.size())});
        if (is_new) body.points.push_back({coordinate(0, at[0]), coordinate(1, at[1]), coordinate(2, at[2])});
        return found->second;
    }

    double coordinate(std::size_t axis, std::uint32_t i) const
    {
        std::size_t gap = 0;
        while (gap + 1 < cuts_[axis].size() && first_[axis][gap + 1] <= i) ++gap;
        const double low = blocks_.planes[axis][gap], high = blocks_.planes[axis][gap + 1];
        return low + (high - low) * (static_cast<double>(i - first_[axis][gap]) / cuts_[axis][gap]);
    }

    const Blocks& blocks_;
    const Cuts& cuts_;
    std::array<std::vector<std::uint32_t>, 3> first_; // cell numbers at the planes
    std::map<Index, std::uint32_t> numbers_;
};

} // namespace

Body block_surface(const Blocks& blocks, std::uint32_t vertices)
{
    const std::vector<Side> sides = outer_sides(blocks);
    const Cuts cuts = even_cuts(blocks, sides, vertices);
    Builder builder(blocks, cuts);
    for (const Side& side : sides) builder.add(side);
    split_edges(builder.body, vertices);
    return std::move(builder.body);
}

} // namespace meshreel::shapes
