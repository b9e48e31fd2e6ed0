/// The nearest points of a moving surface in space-time: layers of cells, alive only near the times that are asked for.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshreel/metrics/space_time_layer.h"

namespace meshreel::metrics {

/// What a grid cost.
struct GridCost {
    std::size_t layers = 0;     ///< built; more than the intervals where some were built again
    std::size_t cells = 0;      ///< of all layers built
    std::size_t entries = 0;    ///< tetrahedra in cells, of all layers built
    std::size_t most_bytes = 0; ///< of the layers that were alive at one time
};

/// A uniform grid in four dimensions over all tetrahedra of a moving surface, one layer an interval. A layer is built when a
/// search reaches it and dropped when the next two searches do not, so that searches should go along the time.
class SpaceTimeGrid {
public:
    /// The surface must outlive it. most_bytes: layers beyond it are dropped as soon as a search has passed them.
    explicit SpaceTimeGrid(const MovingSurface& surface, Threads threads = {}, std::size_t most_bytes = usual_bytes);

    /// Finds the nearest point of each query exactly; the queries should be near each other in time. From the layers at
    /// their time outwards, until no layer can be nearer. Infinite where there is no tetrahedron. The same for any number
    /// of threads.
    void nearest(std::span<NearestQuery> queries);

    const GridCost& cost() const { return cost_; }

private:
    static constexpr std::size_t usual_bytes = std::size_t{1} << 29;

    void search_layer(std::size_t interval, std::span<NearestQuery> queries);
    const SpaceTimeLayer& layer(std::size_t interval);
    void drop(std::size_t interval);

    const MovingSurface& surface_;
    Threads threads_;
    std::size_t most_bytes_;
    double cell_;
    std::vector<std::unique_ptr<SpaceTimeLayer>> layers_;       ///< [intervals], null: not alive
    std::vector<std::size_t> alive_, touched_, touched_before_; ///< intervals; touched: by this search, by the last
    std::size_t bytes_ = 0;
    GridCost cost_;
};

} // namespace meshreel::metrics
