/// Edge lengths of a few frames side by side, summed over the stars of vertices, and those over neighbourhoods.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/sted_spatial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "meshreel/base/wide.h"

namespace meshreel::metrics {

namespace {

#define MESHREEL_STED_INLINE inline __attribute__((always_inline))

constexpr std::size_t sted_lanes = 4; ///< frames measured side by side
constexpr std::size_t sted_batch =
    16; ///< edges or vertices that wait for each other, so that roots fill wide registers

/// A number in some frames.
typedef double StedLanes __attribute__((vector_size(sted_lanes * sizeof(double)), aligned(8)));
using StedBatch = std::array<double, sted_batch * sted_lanes>;

/// A vertex in some frames.
struct StedPoint {
    StedLanes x, y, z;
};

/// Sums over edges: of their lengths in the original, of the differences of length, and of their squares over the length.
/// With weights w and relative differences d these are the sums of w, w d and w d^2.
struct StedSums {
    StedLanes length, difference, square;

    MESHREEL_STED_INLINE void operator+=(const StedSums& other)
    {
        length += other.length;
        difference += other.difference;
        square += other.square;
    }
    MESHREEL_STED_INLINE void operator-=(const StedSums& other)
    {
        length -= other.length;
        difference -= other.difference;
        square -= other.square;
    }
};

/// [V], [V], [E], [V]
struct StedBlock {
    const StedPoint* __restrict original, * __restrict distorted;
    StedSums* __restrict edges, * __restrict stars;
};

using StedEdges = std::span<const std::pair<std::uint32_t, std::uint32_t>>;

MESHREEL_STED_INLINE void store_square(const StedPoint& a, const StedPoint& b, double* square)
{
    const StedLanes x = a.x - b.x, y = a.y - b.y, z = a.z - b.z, sum = x * x + y * y + z * z;
    std::memcpy(square, &sum, sizeof sum);
}

MESHREEL_STED_INLINE void load_lanes(const double* from, StedLanes& lanes)
{
    std::memcpy(&lanes, from, sizeof lanes);
}

/// From squared lengths in the original and the distorted motion to lengths in the original and their differences.
MESHREEL_STED_INLINE void take_differences(StedBatch& length, StedBatch& difference)
{
    for (double& edge : length) edge = std::sqrt(edge); // (7.4)
    for (double& edge : difference) edge = std::sqrt(edge);
    for (std::size_t i = 0; i < length.size(); ++i) difference[i] = length[i] - difference[i];
}

/// The sums of single edges, and of the edges at each vertex, which start at 0.
MESHREEL_WIDEST void measure_edges(const StedBlock& block, StedEdges edges, bool absolute)
{
    StedBatch length{}, difference{}, square{};
    StedSums sums{}; // of the edges at hand with the same lower vertex
    std::uint32_t star = edges.empty() ? 0 : edges.front().first;
    for (std::size_t first = 0; first < edges.size(); first += sted_batch) {
        const std::size_t count = std::min(sted_batch, edges.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const auto [a, b] = edges[first + i];
            store_square(block.original[a], block.original[b], length.data() + i * sted_lanes);
            store_square(block.distorted[a], block.distorted[b], difference.data() + i * sted_lanes);
        }
        // DEVIATES (7.5): signed by default; the authors' tool, which the printed values come from, keeps the sign.
        take_differences(length, difference);
        if (absolute)
            for (double& change : difference) change = std::abs(change);
        for (std::size_t i = 0; i < length.size(); ++i) {
            const double counts = length[i] > 0.0 ? 1.0 : 0.0;
            difference[i] *= counts;
            square[i] = difference[i] / (length[i] + (1.0 - counts)) * difference[i];
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto [low, high] = edges[first + i];
            if (low != star) {
                block.stars[star] += sums;
                sums = StedSums{};
                star = low;
            }
            StedSums edge;
            load_lanes(length.data() + i * sted_lanes, edge.length);
            load_lanes(difference.data() + i * sted_lanes, edge.difference);
            load_lanes(square.data() + i * sted_lanes, edge.square);
            sums += edge;
            block.stars[high] += edge;
            block.edges[first + i] = edge;
        }
    }
    if (!edges.empty()) block.stars[star] += sums;
}

/// Sums the weighted standard deviations of the differences near each vertex of a run; told: [run.size() x sted_lanes] of
/// them, or null.
MESHREEL_WIDEST void measure_vertices(const StedBlock& block, const NearEdges::Run& run, double* __restrict told,
                                      double* __restrict result)
{
    StedBatch lengths{}, differences{}, squares{}, sums{};
    for (std::size_t first = 0; first < run.size(); first += sted_batch) {
        const std::size_t count = std::min<std::size_t>(sted_batch, run.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            StedSums near{};
            const std::size_t v = first + i;
            for (std::size_t s = run.first_star[v]; s < run.first_star[v + 1]; ++s) near += block.stars[run.stars[s]];
            for (std::size_t e = run.first_inner[v]; e < run.first_inner[v + 1]; ++e) near -= block.edges[run.inner[e]];
            std::memcpy(lengths.data() + i * sted_lanes, &near.length, sizeof near.length);
            std::memcpy(differences.data() + i * sted_lanes, &near.difference, sizeof near.difference);
            std::memcpy(squares.data() + i * sted_lanes, &near.square, sizeof near.square);
        }
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            const double length = lengths[i] + (lengths[i] > 0.0 ? 0.0 : 1.0); // else the other sums are 0 too
            const double mean = differences[i] / length;                       // (7.6)
            squares[i] = std::max(0.0, squares[i] / length - mean * mean);
        }
        for (double& deviation : squares) deviation = std::sqrt(deviation); // (7.7)
        for (std::size_t i = 0; i < count * sted_lanes; ++i) sums[i] += squares[i];
        if (told != nullptr) std::copy_n(squares.begin(), count * sted_lanes, told + first * sted_lanes);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) result[i % sted_lanes] += sums[i];
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
    std::vector<double> deviations;
    std::size_t first = 0, used = 0; ///< the frames

    StedBlock block() { return {original.data(), distorted.data(), edges.data(), stars.data()}; }
};

SpatialSted::SpatialSted(std::uint32_t vertex_count, std::span<const Triangle> triangles, const StedOptions& options)
    : vertex_count_(vertex_count), options_(options), near_(vertex_count, triangles, options.distance),
      first_run_(near_.run_from(0))
{
}

SpatialSted::~SpatialSted() = default;

void SpatialSted::add_run(const NearEdges::Run& run, Room& room, Parts& parts) const
{
    const bool told = static_cast<bool>(options_.vertex_errors);
    if (told) room.deviations.resize(run.size() * sted_lanes);
    std::array<double, sted_lanes> sums{};
    measure_vertices(room.block(), run, told ? room.deviations.data() : nullptr, sums.data());
    for (std::size_t lane = 0; lane < room.used; ++lane) parts.sums[room.first + lane] += sums[lane];
    for (std::size_t i = 0; i < run.size() && told; ++i)
        for (std::size_t lane = 0; lane < room.used; ++lane)
            parts.deviations(room.first + lane, run.begin + i) = room.deviations[i * sted_lanes + lane];
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
    while (rooms_.size() < workers) rooms_.push_back(std::make_unique<Room>());
    parallel_for(workers, options_.threads, [&](std::size_t worker) {
        Room& room = *rooms_[worker];
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

#undef MESHREEL_STED_INLINE

} // namespace meshreel::metrics
