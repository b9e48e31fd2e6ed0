/// Boxes, cells by the hyperplane test, and a descent through a pyramid of cells, the nearer child first.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/space_time_layer.h"

#include <algorithm>
#include <cmath>

namespace meshreel::metrics {

namespace {

constexpr std::size_t tetrahedra_a_block = 4096;
constexpr double most_cells = 1 << 21;
constexpr double most_cells_a_tetrahedron = 40.0, free_entries = 4096.0;
/// A ball that touches no more cells than this is looked through directly.
constexpr std::size_t cells_around = 64;
/// A hyperplane counts where its normal is longer than this part of the product of the edges.
constexpr double flat_hyperplane = 1e-6, hyperplane_slack = 1e-6;

std::size_t blocks_of(std::size_t count)
{
    return (count + tetrahedra_a_block - 1) / tetrahedra_a_block;
}

double outside(double x, double low, double high)
{
    return std::max({low - x, x - high, 0.0});
}

} // namespace

std::array<Point4, 4> MovingSurface::corners(std::size_t interval, std::size_t tetrahedron) const
{
    std::array<Point4, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t corner = tetrahedra[tetrahedron][i];
        points[i] =
            corner < vertex_count ? point(interval, corner) : point(later_frame(interval), corner - vertex_count);
    }
    return points;
}

/// What a tetrahedron leaves on either side of itself. Only cells with corners above and below can meet it.
struct SpaceTimeLayer::Hyperplane {
    Point4 normal{}; ///< 0: the tetrahedron is too flat to have one
    Point4 anchor{}; ///< a corner, seen from the low corner of the layer
    double reach =
        0.0; ///< how far the corners of a cell are from its middle along the normal, times the normal's length

    Hyperplane(const SpaceTimeLayer& layer, std::uint32_t tetrahedron)
    {
        const std::array<Point4, 4> c = layer.surface_.corners(layer.interval_, tetrahedron);
        const Point4 u = c[1] - c[0], v = c[2] - c[0], w = c[3] - c[0];
        const Point4 n = metrics::normal(u, v, w);
        const double edges = dot(u, u) * dot(v, v) * dot(w, w);
        if (!(dot(n, n) > flat_hyperplane * flat_hyperplane * edges)) return;
        normal = n;
        anchor = c[0] - layer.low_;
        const double half = layer.cell_ / 2, half_time = (layer.to_ - layer.from_) / 2;
        reach = (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2])) * half + std::abs(n[3]) * half_time;
        reach *= 1.0 + hyperplane_slack;
        anchor[3] -= half_time; // from the middle of the interval
    }

    bool usable() const { return reach > 0.0; }

    /// Cells first .. last - 1 of the row at y, z that have corners on both sides; first and last come in as the row's ends.
    void cut_row(double y, double z, double cell, std::array<std::size_t, 2>& row) const
    {
        const double rest = normal[1] * (y - anchor[1]) + normal[2] * (z - anchor[2]) - normal[3] * anchor[3];
        const auto first = static_cast<double>(row[0]), last = static_cast<double>(row[1]);
        if (std::abs(normal[0]) * (last - first) * cell <= 1e-9 * reach) {
            if (std::abs(rest + normal[0] * ((first + 0.5) * cell - anchor[0])) > reach) row[1] = row[0];
            return;
        }
        const double a = anchor[0] + (-reach - rest) / normal[0], b = anchor[0] + (reach - rest) / normal[0];
        const double low = std::ceil(std::min(a, b) / cell - 0.5), high = std::floor(std::max(a, b) / cell - 0.5) + 1.0;
        row[0] = static_cast<std::size_t>(std::clamp(low, first, last));
        row[1] = static_cast<std::size_t>(std::clamp(high, static_cast<double>(row[0]), last));
    }
};

SpaceTimeLayer::SpaceTimeLayer(const MovingSurface& surface, std::size_t interval, double cell, Threads threads)
    : surface_(surface), interval_(interval), from_(surface.axis[interval]),
      to_(surface.axis[surface.later_frame(interval)]), boxes_(surface.tetrahedra.size())
{
    find_boxes(threads);
    choose_cells(cell);
    std::vector<std::vector<Entry>> blocks(blocks_of(boxes_.size()));
    parallel_for(blocks.size(), threads, [&](std::size_t b) {
        const std::size_t end = std::min(boxes_.size(), (b + 1) * tetrahedra_a_block);
        for (std::size_t t = b * tetrahedra_a_block; t < end; ++t) enter(static_cast<std::uint32_t>(t), blocks[b]);
    });
    sort_in(blocks);
    build_pyramid();
}

void SpaceTimeLayer::find_boxes(Threads threads)
{
    parallel_for(blocks_of(boxes_.size()), threads, [&](std::size_t b) {
        const std::size_t end = std::min(boxes_.size(), (b + 1) * tetrahedra_a_block);
        for (std::size_t t = b * tetrahedra_a_block; t < end; ++t) {
            const std::array<Point4, 4> corners = surface_.corners(interval_, t);
            for (std::size_t c = 0; c < 3; ++c) { // exact: the coordinates are floats
                const auto [low, high] = std::minmax({corners[0][c], corners[1][c], corners[2][c], corners[3][c]});
                boxes_[t][c] = static_cast<float>(low);
                boxes_[t][c + 3] = static_cast<float>(high);
            }
        }
    });
}

void SpaceTimeLayer::choose_cells(double cell)
{
    low_ = {0, 0, 0, from_};
    high_ = {0, 0, 0, to_};
    for (std::size_t c = 0; c < 3 && !boxes_.empty(); ++c) {
        low_[c] = boxes_[0][c];
        high_[c] = boxes_[0][c + 3];
        for (const Box& box : boxes_) {
            low_[c] = std::min<double>(low_[c], box[c]);
            high_[c] = std::max<double>(high_[c], box[c + 3]);
        }
    }
    for (cell_ = cell; !cells_suffice(); cell_ *= 2) {
    }
    for (std::size_t c = 0; c < 3; ++c) dims_[c] = static_cast<std::size_t>((high_[c] - low_[c]) / cell_) + 1;
}

bool SpaceTimeLayer::cells_suffice() const
{
    double cells = 1.0, entries = 0.0;
    for (std::size_t c = 0; c < 3; ++c) cells *= std::floor((high_[c] - low_[c]) / cell_) + 1.0;
    if (cells > most_cells) return false;
    const double bound = most_cells_a_tetrahedron * static_cast<double>(boxes_.size()) + free_entries;
    for (const Box& box : boxes_) {
        double there = 1.0;
        for (std::size_t c = 0; c < 3; ++c) there *= static_cast<double>(box[c + 3] - box[c]) / cell_ + 1.0;
        entries += there;
        if (entries > bound) return false;
    }
    return true;
}

std::size_t SpaceTimeLayer::cell_of(double x, std::size_t axis) const
{
    return static_cast<std::size_t>(std::clamp((x - low_[axis]) / cell_, 0.0, static_cast<double>(dims_[axis] - 1)));
}

void SpaceTimeLayer::enter(std::uint32_t tetrahedron, std::vector<Entry>& entries) const
{
    const Box& box = boxes_[tetrahedron];
    Cell low, high;
    for (std::size_t c = 0; c < 3; ++c) {
        low[c] = cell_of(box[c], c);
        high[c] = cell_of(box[c + 3], c) + 1;
    }
    const Hyperplane plane(*this, tetrahedron);
    for (std::size_t z = low[2]; z < high[2]; ++z)
        for (std::size_t y = low[1]; y < high[1]; ++y) {
            std::array<std::size_t, 2> row{low[0], high[0]};
            if (plane.usable())
                plane.cut_row((static_cast<double>(y) + 0.5) * cell_, (static_cast<double>(z) + 0.5) * cell_, cell_,
                              row);
            for (std::size_t x = row[0]; x < row[1]; ++x)
                entries.push_back({static_cast<std::uint32_t>((z * dims_[1] + y) * dims_[0] + x), tetrahedron});
        }
}

void SpaceTimeLayer::sort_in(const std::vector<std::vector<Entry>>& blocks)
{
    starts_.assign(cell_count() + 1, 0);
    for (const std::vector<Entry>& block : blocks)
        for (const Entry& entry : block) ++starts_[entry.cell];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts_) start = sum += start; // the end of each cell; filled from behind
    entries_.resize(sum);
    for (std::size_t b = blocks.size(); b-- > 0;)
        for (std::size_t i = blocks[b].size(); i-- > 0;)
            entries_[--starts_[blocks[b][i].cell]] = blocks[b][i].tetrahedron;
}

void SpaceTimeLayer::build_pyramid()
{
    pyramid_.push_back({dims_, std::vector<std::uint8_t>(cell_count())});
    for (std::size_t c = 0; c < cell_count(); ++c) pyramid_[0].used[c] = starts_[c] < starts_[c + 1];
    while (pyramid_.back().used.size() > 1) {
        const Level& fine = pyramid_.back();
        const Cell& n = fine.dims;
        Level coarse{{(n[0] + 1) / 2, (n[1] + 1) / 2, (n[2] + 1) / 2}, {}};
        coarse.used.assign(coarse.dims[0] * coarse.dims[1] * coarse.dims[2], 0);
        for (std::size_t i = 0; i < fine.used.size(); ++i) {
            const std::size_t x = i % n[0], y = i / n[0] % n[1], z = i / (n[0] * n[1]);
            coarse.used[(z / 2 * coarse.dims[1] + y / 2) * coarse.dims[0] + x / 2] |= fine.used[i];
        }
        pyramid_.push_back(std::move(coarse));
    }
}

std::size_t SpaceTimeLayer::bytes() const
{
    std::size_t sum = boxes_.size() * sizeof(Box) + (starts_.size() + entries_.size()) * sizeof(std::uint32_t);
    for (const Level& level : pyramid_) sum += level.used.size();
    return sum;
}

double SpaceTimeLayer::squared_gap(double w) const
{
    const double gap = outside(w, from_, to_);
    return gap * gap;
}

double SpaceTimeLayer::squared_to_box(const Search& search, std::uint32_t tetrahedron) const
{
    const Box& box = boxes_[tetrahedron];
    double sum = search.squared_gap;
    for (std::size_t c = 0; c < 3; ++c) {
        const double gap = outside(search.query.at[c], box[c], box[c + 3]);
        sum += gap * gap;
    }
    return sum;
}

double SpaceTimeLayer::squared_to_cells(const Search& search, const Cell& low, const Cell& high) const
{
    double sum = search.squared_gap;
    for (std::size_t c = 0; c < 3; ++c) {
        const double x = search.query.at[c] - low_[c];
        const double gap = outside(x, static_cast<double>(low[c]) * cell_, static_cast<double>(high[c]) * cell_);
        sum += gap * gap;
    }
    return sum;
}

void SpaceTimeLayer::test(const Search& search, std::uint32_t tetrahedron) const
{
    NearestQuery& query = search.query;
    if (!search.met.first_time(tetrahedron) || squared_to_box(search, tetrahedron) >= query.squared) return;
    const double squared =
        squared_distance_to_tetrahedron(query.at, surface_.corners(interval_, tetrahedron), query.squared);
    if (squared >= query.squared) return;
    query.squared = squared;
    query.nearest = tetrahedron;
}

void SpaceTimeLayer::search_cell(const Search& search, const Cell& cell) const
{
    const std::size_t c = (cell[2] * dims_[1] + cell[1]) * dims_[0] + cell[0];
    for (std::uint32_t i = starts_[c]; i < starts_[c + 1]; ++i) test(search, entries_[i]);
}

/// Looks through the cells that the ball around the point touches. False: they are too many.
bool SpaceTimeLayer::search_around(const Search& search) const
{
    const NearestQuery& query = search.query;
    const double radius = std::sqrt(query.squared - search.squared_gap) * (1.0 + 1e-12);
    Cell low, high;
    for (std::size_t c = 0; c < 3; ++c) {
        low[c] = cell_of(query.at[c] - radius, c);
        high[c] = cell_of(query.at[c] + radius, c) + 1;
    }
    if ((high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]) > cells_around) return false;
    for (std::size_t z = low[2]; z < high[2]; ++z)
        for (std::size_t y = low[1]; y < high[1]; ++y)
            for (std::size_t x = low[0]; x < high[0]; ++x)
                if (squared_to_cells(search, {x, y, z}, {x + 1, y + 1, z + 1}) < query.squared)
                    search_cell(search, {x, y, z});
    return true;
}

void SpaceTimeLayer::descend(const Search& search, std::size_t level, const Cell& node) const
{
    const NearestQuery& query = search.query;
    const Level& here = pyramid_[level];
    if (here.used[(node[2] * here.dims[1] + node[1]) * here.dims[0] + node[0]] == 0) return;
    const std::size_t size = std::size_t{1} << level;
    const Cell low{node[0] * size, node[1] * size, node[2] * size};
    if (squared_to_cells(search, low, {low[0] + size, low[1] + size, low[2] + size}) >= query.squared) return;
    if (level == 0) return search_cell(search, node);
    std::size_t nearer = 0; // bit c: the point is in the upper half along c
    for (std::size_t c = 0; c < 3; ++c)
        if (query.at[c] - low_[c] > static_cast<double>(low[c] + size / 2) * cell_) nearer |= std::size_t{1} << c;
    const Cell& dims = pyramid_[level - 1].dims;
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t which = i ^ nearer;
        const Cell child{2 * node[0] + (which & 1), 2 * node[1] + (which >> 1 & 1), 2 * node[2] + (which >> 2)};
        if (child[0] < dims[0] && child[1] < dims[1] && child[2] < dims[2]) descend(search, level - 1, child);
    }
}

void SpaceTimeLayer::search(NearestQuery& query, MetTetrahedra& met) const
{
    const Search search{query, met, squared_gap(query.at[3])};
    if (search.squared_gap >= query.squared || boxes_.empty()) return;
    met.start_search();
    if (query.nearest != NearestQuery::nothing) test(search, query.nearest);
    if (search.squared_gap >= query.squared) return;
    if (std::isfinite(query.squared) && search_around(search)) return;
    descend(search, pyramid_.size() - 1, {0, 0, 0});
}

} // namespace meshreel::metrics
