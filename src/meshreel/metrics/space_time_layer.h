/// One interval of a moving surface in space-time: its tetrahedra in the cells of a grid.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/mesh/space_time.h"
#include "meshreel/metrics/tetrahedron_distance.h"

namespace meshreel::metrics {

/// A moving surface as tetrahedra, three for each triangle and interval. A single frame is one interval of no length.
struct MovingSurface {
    std::uint32_t vertex_count = 0;          ///< V
    std::span<const Tetrahedron> tetrahedra; ///< [3T] of any interval (interval_tetrahedra)
    MatrixView<const float> frames;          ///< [F x 3V]
    std::span<const double> axis;            ///< [F] the time of each frame in model units, never falling

    std::size_t intervals() const { return frames.rows > 1 ? frames.rows - 1 : frames.rows; }
    std::size_t later_frame(std::size_t interval) const { return frames.rows > 1 ? interval + 1 : interval; }
    Point4 point(std::size_t frame, std::uint32_t vertex) const
    {
        const float* p = frames.data + frame * frames.cols + 3ul * vertex;
        return {p[0], p[1], p[2], axis[frame]};
    }
    std::array<Point4, 4> corners(std::size_t interval, std::size_t tetrahedron) const;
};

/// A point in space-time whose nearest point of a surface is looked for.
struct NearestQuery {
    static constexpr std::uint32_t nothing = 0xffffffff;
    Point4 at{};
    double squared = std::numeric_limits<double>::infinity(); ///< the distance to the nearest point found so far
    std::uint32_t nearest = nothing; ///< the tetrahedron that has it; before a search, one that is likely near
};

/// Which tetrahedra a search has met already: one may lie in many cells.
class MetTetrahedra {
public:
    explicit MetTetrahedra(std::size_t count) : met_(count) {}
    void start_search() { ++search_; }
    bool first_time(std::uint32_t tetrahedron) { return std::exchange(met_[tetrahedron], search_) != search_; }

private:
    std::vector<std::uint32_t> met_; ///< the search that met it last
    std::uint32_t search_ = 0;
};

/// The tetrahedra of one interval. Cells are cubes in space, as long in time as the interval.
class SpaceTimeLayer {
public:
    /// cell: the edge of a cell, > 0; it is doubled until the tetrahedra need no more than some 40 cells each, and the
    /// layer no more than 2 million. The surface must outlive it.
    SpaceTimeLayer(const MovingSurface& surface, std::size_t interval, double cell, Threads threads);

    /// How far a time is from the interval, squared.
    double squared_gap(double w) const;
    /// Lowers query.squared and sets query.nearest where this layer has a nearer point. met: for fewer than 2^32 searches.
    void search(NearestQuery& query, MetTetrahedra& met) const;

    std::size_t cell_count() const { return dims_[0] * dims_[1] * dims_[2]; }
    std::size_t entry_count() const { return entries_.size(); }
    std::size_t bytes() const;

private:
    using Box = std::array<float, 6>; ///< least x y z, largest x y z
    using Cell = std::array<std::size_t, 3>;
    struct Entry {
        std::uint32_t cell, tetrahedron;
    };
    struct Level { ///< of the pyramid over the cells: each eight of one level are one of the next
        Cell dims;
        std::vector<std::uint8_t> used;
    };
    struct Hyperplane;
    struct Search {
        NearestQuery& query;
        MetTetrahedra& met;
        double squared_gap; ///< in time
    };

    void find_boxes(Threads threads);
    void choose_cells(double cell);
    bool cells_suffice() const;
    std::size_t cell_of(double x, std::size_t axis) const;
    void enter(std::uint32_t tetrahedron, std::vector<Entry>& entries) const;
    void sort_in(const std::vector<std::vector<Entry>>& blocks);
    void build_pyramid();
    double squared_to_box(const Search& search, std::uint32_t tetrahedron) const;
    double squared_to_cells(const Search& search, const Cell& low, const Cell& high) const;
    void test(const Search& search, std::uint32_t tetrahedron) const;
    void search_cell(const Search& search, const Cell& cell) const;
    bool search_around(const Search& search) const;
    void descend(const Search& search, std::size_t level, const Cell& node) const;

    const MovingSurface& surface_;
    std::size_t interval_;
    double from_, to_; ///< the interval on the time axis
    std::vector<Box> boxes_;
    Point4 low_{}, high_{}; ///< of all boxes
    double cell_ = 1.0;
    Cell dims_{1, 1, 1};
    std::vector<std::uint32_t> starts_, entries_; ///< tetrahedra of cell c: entries_[starts_[c] .. starts_[c + 1])
    std::vector<Level> pyramid_;                  ///< the first one over the cells themselves
};

} // namespace meshreel::metrics
