/// Topology-guided decimation: level after level of vertices goes, and both sides see the same coarser meshes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include "meshreel/connectivity/hole.h"
#include "meshreel/connectivity/surface.h"

namespace meshreel::connectivity {

constexpr int most_levels = 31;

/// A mesh that loses vertices, a level at a time.
///
/// Holes are found in the mesh as it was when the level began, and a vertex that goes locks its neighbours: so what a
/// level leaves does not depend on the order in which its vertices go. The mesh stays as manifold as it was and keeps
/// its Euler number; non-manifold and isolated vertices stay.
class Decimator {
public:
    explicit Decimator(const Surface& surface);

    std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(state_.size()); }
    std::uint32_t live_count() const { return live_count_; }
    bool live(std::uint32_t v) const { return state_[v] != State::gone; }
    /// Neither gone nor next to a vertex that goes at this level.
    bool unlocked(std::uint32_t v) const { return state_[v] == State::unlocked; }
    /// The mesh as it was when this level began.
    Mesh mesh() const { return {triangles_, stars_}; }
    /// As connectivity::find_hole.
    bool find_hole(std::uint32_t v, Hole& hole) const { return connectivity::find_hole(mesh(), v, hole); }
    /// v is unlocked, and its hole shares no claim with those that were made at this level.
    bool may_go(std::uint32_t v, const Hole& hole) const;
    /// Takes v away and locks its neighbours.
    void remove(std::uint32_t v, const Hole& hole);
    /// Closes the holes, in the order of their vertices, and unlocks everyone left.
    void next_level();

private:
    enum class State : std::uint8_t { unlocked, locked, gone };
    struct Patch {
        std::uint32_t vertex;
        std::vector<Triangle> triangles;
    };

    std::vector<Triangle> triangles_;
    Stars stars_;
    std::vector<State> state_;
    std::uint32_t live_count_;
    std::vector<Patch> patches_;
    std::set<Edge> claims_;
};

/// A decimated surface, its vertices in the order in which a codec codes them: row by row, the coarsest mesh first.
struct Decimation {
    std::vector<std::uint32_t> vertex_of;  ///< [W] the surface's vertex of each row
    std::vector<std::uint32_t> row_counts; ///< [levels + 1] rows of the coarsest mesh, .. of the next finer, .. W
    std::vector<Gate> gates;               ///< [row_counts[0]] of the coarsest mesh, traced; in rows
    std::vector<Triangle> coarsest;        ///< triangles of the coarsest mesh, in rows
    std::vector<std::uint32_t> ring_begin; ///< [W - row_counts[0] + 1]
    std::vector<std::uint32_t> rings;      ///< in rows: neighbours of each finer row when it went; all of earlier rows

    std::uint32_t coarse_count() const { return row_counts.front(); }
    std::span<const std::uint32_t> ring(std::uint32_t row) const
    {
        const std::uint32_t i = row - coarse_count();
        return std::span(rings).subspan(ring_begin[i], ring_begin[i + 1] - ring_begin[i]);
    }
};

/// What is known about a vertex that may go, as a context for coding whether it does.
constexpr std::uint32_t removal_contexts = 72;

/// Asks whether a vertex goes. context: 0 .. removal_contexts - 1.
using Goes = std::function<bool(std::uint32_t level, std::uint32_t v, std::uint32_t context)>;

/// Takes away `levels` levels of vertices: at each, every vertex in turn that may go is asked for once. Whatever the
/// answers, the result is sound.
/// levels <= most_levels.
/// @cost O(levels (W + T)); memory decimation_bytes().  @source thesis 8.2
Decimation decimate(const Surface& surface, int levels, const Goes& goes);

/// Memory that decimate() takes, result included, bytes.
std::uint64_t decimation_bytes(const Surface& surface);

} // namespace meshreel::connectivity
