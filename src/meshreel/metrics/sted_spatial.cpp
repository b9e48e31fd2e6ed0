/// Edge lengths of a few frames side by side, summed over the stars of vertices, and those over neighbourhoods.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/sted_spatial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "meshreel/base/wide.h"

namespace meshreel::metrics {

namespace {

constexpr std::size_t sted_lanes = 4; ///< frames measured side by side

using StedLanes = std::array<double, sted_lanes>;

/// A vertex in some frames.
struct StedPoint {
    StedLanes x, y, z;
};

/// Sums over edges: of their lengths in the original, of the differences of length, and of their squares over the length.
/// With weights w and relative differences d these are the sums of w, w d and w d^2.
struct StedSums {
    StedLanes length, difference, square;
};

/// [V], [V], [E], [V]
struct StedBlock {
    const StedPoint* __restrict original, * __restrict distorted;
    StedSums* __restrict edges, * __restrict stars;
};

using StedEdges = std::span<const std::pair<std::uint32_t, std::uint32_t>>;

/// The sums of single edges, and of the edges at each vertex, which start at 0.
MESHREEL_WIDE void measure_edges(const StedBlock& block, StedEdges edges, bool absolute)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const StedPoint &a = block.original[edges[e].first], &b = block.original[edges[e].second];
        const StedPoint &c = block.distorted[edges[e].first], &d = block.distorted[edges[e].second];
        StedSums edge;
        for (std::size_t lane = 0; lane < sted_lanes; ++lane) {
            const double x = a.x[lane] - b.x[lane], y = a.y[lane] - b.y[lane], z = a.z[lane] - b.z[lane];
            const double u = c.x[lane] - d.x[lane], v = c.y[lane] - d.y[lane], w = c.z[lane] - d.z[lane];
            const double length = std::sqrt(x * x + y * y + z * z); // (7.4)
            const double signed_difference = length - std::sqrt(u * u + v * v + w * w);
            // DEVIATES (7.5): signed by default; the authors' tool, which the printed values come from, keeps the sign.
            const double kept = absolute ? std::abs(signed_difference) : signed_difference;
            const double difference = length > 0.0 ? kept : 0.0, divisor = length > 0.0 ? length : 1.0;
            edge.length[lane] = length;
            edge.difference[lane] = difference;
            edge.square[lane] = difference / divisor * difference;
        }
        block.edges[e] = edge;
        for (const std::uint32_t end : {edges[e].first, edges[e].second}) {
            StedSums& star = block.stars[end];
            for (std::size_t lane = 0; lane < sted_lanes; ++lane) {
                star.length[lane] += edge.length[lane];
                star.difference[lane] += edge.difference[lane];
                star.square[lane] += edge.square[lane];
            }
        }
    }
}

/// The weighted standard deviation of the differences near each vertex of a run, [run.size()].
MESHREEL_WIDE void measure_vertices(const StedBlock& block, const NearEdges::Run& run, StedLanes* __restrict deviations)
{
    for (std::size_t i = 0; i < run.size(); ++i) {
        StedSums near{};
        for (std::size_t s = run.first_star[i]; s < run.first_star[i + 1]; ++s)
            for (std::size_t lane = 0; lane < sted_lanes; ++lane) {
                near.length[lane] += block.stars[run.stars[s]].length[lane];
                near.difference[lane] += block.stars[run.stars[s]].difference[lane];
                near.square[lane] += block.stars[run.stars[s]].square[lane];
            }
        for (std::size_t e = run.first_inner[i]; e < run.first_inner[i + 1]; ++e)
            for (std::size_t lane = 0; lane < sted_lanes; ++lane) {
                near.length[lane] -= block.edges[run.inner[e]].length[lane];
                near.difference[lane] -= block.edges[run.inner[e]].difference[lane];
                near.square[lane] -= block.edges[run.inner[e]].square[lane];
            }
        for (std::size_t lane = 0; lane < sted_lanes; ++lane) {
            const double length = near.length[lane] > 0.0 ? near.length[lane] : 1.0; // else the other sums are 0 too
            const double mean = near.difference[lane] / length;                      // (7.6)
            const double variance = near.square[lane] / length - mean * mean;
            deviations[i][lane] = std::sqrt(variance > 0.0 ? variance : 0.0); // (7.7)
        }
    }
}

/// The points of frames first .. first + sted_lanes - 1; beyond the end the last frame repeats.
template <class T>
void take_points(MatrixView<const T> frames, std::size_t first, std::span<StedPoint> points)
{
    std::array<const T*, sted_lanes> rows{};
    for (std::size_t lane = 0; lane < sted_lanes; ++lane)
        rows[lane] = frames.row(std::min(first + lane, frames.rows - 1)).data();
    for (std::size_t v = 0; v < points.size(); ++v)
        for (std::size_t lane = 0; lane < sted_lanes; ++lane) {
            points[v].x[lane] = rows[lane][3 * v];
            points[v].y[lane] = rows[lane][3 * v + 1];
            points[v].z[lane] = rows[lane][3 * v + 2];
        }
}

} // namespace

struct SpatialSted::Room {
    std::vector<StedPoint> original, distorted;
    std::vector<StedSums> edges, stars;
    std::vector<StedLanes> deviations;
    std::size_t first = 0, used = 0; ///< the frames

    StedBlock block() { return {original.data(), distorted.data(), edges.data(), stars.data()}; }
};

SpatialSted::SpatialSted(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options)
    : vertex_count_(vertex_count), options_(options), near_(vertex_count, triangles, options.distance),
      first_run_(near_.run_from(0))
{
}

void SpatialSted::add_run(const NearEdges::Run& run, Room& room, Parts& parts) const
{
    room.deviations.resize(run.size());
    measure_vertices(room.block(), run, room.deviations.data());
    for (std::size_t i = 0; i < run.size(); ++i)
        for (std::size_t lane = 0; lane < room.used; ++lane) parts.sums[room.first + lane] += room.deviations[i][lane];
    for (std::size_t i = 0; i < run.size() && options_.vertex_errors; ++i)
        for (std::size_t lane = 0; lane < room.used; ++lane)
            parts.deviations(room.first + lane, run.begin + i) = room.deviations[i][lane];
}

template <class T>
void SpatialSted::add_block(const Pair<T>& frames, Room& room, Parts& parts) const
{
    room.used = std::min(sted_lanes, frames.frame_count() - room.first);
    room.original.resize(vertex_count_);
    room.distorted.resize(vertex_count_);
    room.edges.resize(near_.edges().size());
    room.stars.assign(vertex_count_, StedSums{});
    take_points(frames.original, room.first, std::span(room.original));
    take_points(frames.distorted, room.first, std::span(room.distorted));
    measure_edges(room.block(), near_.edges(), options_.absolute_difference);
    add_run(first_run_, room, parts);
    if (first_run_.size() == vertex_count_) return;
    NearEdges lists = near_; // it marks what it has met
    for (std::uint32_t v = first_run_.size(); v < vertex_count_;) {
        const NearEdges::Run run = lists.run_from(v);
        add_run(run, room, parts);
        v += run.size();
    }
}

template <class T>
void SpatialSted::add_frames(const Pair<T>& frames)
{
    Parts parts{std::vector<double>(frames.frame_count(), 0.0), {}};
    if (options_.vertex_errors) parts.deviations = Matrix<double>(frames.frame_count(), vertex_count_);
    const std::size_t blocks = (frames.frame_count() + sted_lanes - 1) / sted_lanes,
                      workers = std::min<std::size_t>(blocks, options_.threads.used());
    parallel_for(workers, options_.threads, [&](std::size_t worker) {
        Room room;
        for (std::size_t block = worker; block < blocks; block += workers) {
            room.first = block * sted_lanes;
            add_block(frames, room, parts);
        }
    });
    for (std::size_t f = 0; f < frames.frame_count(); ++f) {
        if (options_.vertex_errors) options_.vertex_errors(per_frame_.size(), parts.deviations.row(f));
        per_frame_.push_back(vertex_count_ == 0 ? 0.0 : parts.sums[f] / vertex_count_);
    }
}

template void SpatialSted::add_frames(const Pair<float>&);
template void SpatialSted::add_frames(const Pair<double>&);

double SpatialSted::value() const
{
    double sum = 0;
    for (const double frame : per_frame_) sum += frame;
    return per_frame_.empty() ? 0.0 : sum / static_cast<double>(per_frame_.size()); // (7.8)
}

} // namespace meshreel::metrics
