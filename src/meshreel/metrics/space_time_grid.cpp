/// Layers outwards in time from the queries; those that the last two searches did not need are dropped.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/space_time_grid.h"

#include <algorithm>
#include <cmath>

namespace meshreel::metrics {

namespace {

constexpr std::size_t queries_a_block = 256;
/// A cell's edge in edges of the square that has a triangle's area.
constexpr double cell_factor = 2.0;
constexpr std::size_t frames_looked_at = 8;

double triangle_area_4d(const MovingSurface& surface, std::size_t frame, std::size_t triangle)
{
    const Tetrahedron& t = surface.tetrahedra[3 * triangle]; // its first three corners are the triangle
    const Point4 a = surface.point(frame, t[0]), b = surface.point(frame, t[1]), c = surface.point(frame, t[2]);
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

/// The edge of the cells: of the size of a typical triangle; for triangles without area, a part of the whole.
double cell_edge(const MovingSurface& surface)
{
    const std::size_t F = surface.frames.rows, T = surface.tetrahedra.size() / 3;
    if (T == 0 || F == 0) return 1.0;
    double area = 0.0, extent = 0.0;
    std::size_t looked_at = 0;
    for (std::size_t f = 0; f < F; f += std::max<std::size_t>(1, F / frames_looked_at), ++looked_at) {
        for (std::size_t t = 0; t < T; ++t) area += triangle_area_4d(surface, f, t);
        const auto [low, high] = std::minmax_element(surface.frames.row(f).begin(), surface.frames.row(f).end());
        extent = std::max(extent, static_cast<double>(*high) - static_cast<double>(*low));
    }
    const double typical = cell_factor * std::sqrt(area / static_cast<double>(looked_at * T));
    const double least = extent * 1e-6; // layers double it until it is right
    return typical > least ? typical : extent > 0.0 ? extent / 64 : 1.0;
}

} // namespace

SpaceTimeGrid::SpaceTimeGrid(const MovingSurface& surface, Threads threads, std::size_t most_bytes)
    : surface_(surface), threads_(threads), most_bytes_(most_bytes), cell_(cell_edge(surface)),
      layers_(surface.tetrahedra.empty() ? 0 : surface.intervals())
{
}

const SpaceTimeLayer& SpaceTimeGrid::layer(std::size_t interval)
{
    std::unique_ptr<SpaceTimeLayer>& there = layers_[interval];
    if (!there) {
        there = std::make_unique<SpaceTimeLayer>(surface_, interval, cell_, threads_);
        alive_.push_back(interval);
        bytes_ += there->bytes();
        ++cost_.layers;
        cost_.cells += there->cell_count();
        cost_.entries += there->entry_count();
        cost_.most_bytes = std::max(cost_.most_bytes, bytes_);
    }
    return *there;
}

void SpaceTimeGrid::drop(std::size_t interval)
{
    bytes_ -= layers_[interval]->bytes();
    layers_[interval].reset();
}

void SpaceTimeGrid::search_layer(std::size_t interval, std::span<NearestQuery> queries)
{
    const SpaceTimeLayer& there = layer(interval);
    const std::size_t blocks = (queries.size() + queries_a_block - 1) / queries_a_block;
    parallel_for(blocks, threads_, [&](std::size_t b) {
        const std::size_t end = std::min(queries.size(), (b + 1) * queries_a_block);
        MetTetrahedra met(surface_.tetrahedra.size());
        for (std::size_t i = b * queries_a_block; i < end; ++i) there.search(queries[i], met);
    });
    touched_.push_back(interval);
    if (bytes_ > most_bytes_) {
        std::erase(alive_, interval);
        drop(interval);
    }
}

void SpaceTimeGrid::nearest(std::span<NearestQuery> queries)
{
    if (queries.empty() || layers_.empty()) return;
    const auto [first, last] = std::minmax_element(queries.begin(), queries.end(),
                                                   [](const auto& a, const auto& b) { return a.at[3] < b.at[3]; });
    const double from = first->at[3], to = last->at[3];
    const auto start_of = [&](std::size_t i) { return surface_.axis[i]; };
    const auto end_of = [&](std::size_t i) { return surface_.axis[surface_.later_frame(i)]; };
    std::swap(touched_, touched_before_);
    touched_.clear();
    // The first layer that does not end before the queries; from there down and up in time, the nearer one first.
    std::size_t up = 0;
    while (up < layers_.size() && end_of(up) < from) ++up;
    std::size_t down = up;
    for (bool searching = true; searching;) {
        double farthest = 0.0;
        for (const NearestQuery& query : queries) farthest = std::max(farthest, query.squared);
        const double above = up < layers_.size() ? std::max(start_of(up) - to, 0.0) : HUGE_VAL;
        const double below = down > 0 ? std::max(from - end_of(down - 1), 0.0) : HUGE_VAL;
        const double gap = std::min(above, below);
        searching = gap * gap < farthest && gap < HUGE_VAL;
        if (searching) search_layer(above <= below ? up++ : --down, queries);
    }
    std::erase_if(alive_, [&](std::size_t i) {
        const bool used = std::find(touched_.begin(), touched_.end(), i) != touched_.end() ||
                          std::find(touched_before_.begin(), touched_before_.end(), i) != touched_before_.end();
        if (!used) drop(i);
        return !used;
    });
}

} // namespace meshreel::metrics
