/// Two passes over the posed frames: what lengths are, then steps towards them.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/relaxation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshreel/base/wide.h"

namespace meshreel::codecs {

namespace {

constexpr std::size_t relax_lanes = 8;                               // frames side by side: one register of AVX-512
constexpr std::size_t relax_width = 3 * relax_lanes;                 // x, y, z of one vertex in all of them
constexpr std::uint64_t relax_most_run = 16;                         // blocks of frames at a time
constexpr std::uint64_t relax_run_bytes = 1ull << 26;                // that they should not exceed, unless two do
constexpr std::uint64_t relax_vertex_bytes = 3ull * 8 * relax_width; // a block's places, their slopes, where they were

/// Blocks of frames at a time; what comes out does not depend on it.
std::uint64_t relax_run(std::uint64_t W)
{
    return std::clamp<std::uint64_t>(relax_run_bytes / (relax_vertex_bytes * W + 1), 2, relax_most_run);
}

struct ElasticEdge {
    std::uint32_t i = 0, j = 0;
    double length = 0.0, weight = 0.0;
};

/// Sums over frames of an edge's length less `base`, its length in the first frame, and of the squares.
struct LengthSums {
    double base = 0.0, sum = 0.0, squares = 0.0;
};

/// Each edge of two different vertices once, in rising order.
std::vector<ElasticEdge> edges_of(std::span<const Triangle> triangles)
{
    std::vector<std::uint64_t> keys;
    keys.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint64_t a = std::min(t[c], t[(c + 1) % 3]), b = std::max(t[c], t[(c + 1) % 3]);
            if (a != b) keys.push_back(a << 32 | b);
        }
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    std::vector<ElasticEdge> edges(keys.size());
    for (std::size_t e = 0; e < keys.size(); ++e)
        edges[e] = {static_cast<std::uint32_t>(keys[e] >> 32), static_cast<std::uint32_t>(keys[e]), 0.0, 0.0};
    return edges;
}

/// Mean and basis of one block, [relax_width] and [K x relax_width]; frames beyond the last are 0.
struct BlockBasis {
    std::vector<double> mean, rows;

    BlockBasis(const Basis& basis, std::size_t block) : mean(relax_width, 0.0), rows(basis.rows.rows * relax_width, 0.0)
    {
        const std::size_t F = basis.mean.size() / 3, first = block * relax_lanes,
                          count = std::min(relax_lanes, F - first);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t l = 0; l < count; ++l) mean[c * relax_lanes + l] = basis.mean[c * F + first + l];
        for (std::size_t k = 0; k < basis.rows.rows; ++k)
            for (std::size_t c = 0; c < 3; ++c)
                std::copy_n(basis.rows.row(k).data() + c * F + first, count,
                            rows.data() + k * relax_width + c * relax_lanes);
    }
};

/// One vertex in the frames of a block (8.2). c [K].
MESHREEL_WIDEST void pose_vertex(const BlockBasis& basis, std::span<const double> c, double* __restrict x)
{
    double sums[relax_width];
    for (std::size_t i = 0; i < relax_width; ++i) sums[i] = basis.mean[i];
    const double* __restrict b = basis.rows.data();
    for (std::size_t k = 0; k < c.size(); ++k, b += relax_width)
        for (std::size_t i = 0; i < relax_width; ++i) sums[i] += b[i] * c[k];
    for (std::size_t i = 0; i < relax_width; ++i) x[i] = sums[i];
}

/// All vertices, [W x relax_width].
std::vector<double> posed_block(const BlockBasis& basis, MatrixView<const double> C)
{
    std::vector<double> x(C.rows * relax_width);
    for (std::size_t v = 0; v < C.rows; ++v) pose_vertex(basis, C.row(v), x.data() + v * relax_width);
    return x;
}

/// Of one edge, from end to end.
struct EdgeInBlock {
    double along[relax_width], length[relax_lanes];
};

inline void measure_edge(const ElasticEdge& edge, const double* __restrict x, EdgeInBlock& found)
{
    const double* __restrict a = x + edge.i * relax_width, * __restrict b = x + edge.j * relax_width;
    for (std::size_t i = 0; i < relax_width; ++i) found.along[i] = a[i] - b[i];
    for (std::size_t l = 0; l < relax_lanes; ++l) {
        const double dx = found.along[l], dy = found.along[relax_lanes + l], dz = found.along[2 * relax_lanes + l];
        found.length[l] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
}

/// sums [E] of the first `count` frames of a block, in their order.
MESHREEL_WIDEST void add_lengths(std::span<const ElasticEdge> edges, const double* __restrict x, std::size_t count,
                                 LengthSums* __restrict sums)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        EdgeInBlock found;
        measure_edge(edges[e], x, found);
        for (std::size_t l = 0; l < count; ++l) {
            const double more = found.length[l] - sums[e].base;
            sums[e].sum += more;
            sums[e].squares += more * more;
        }
    }
}

/// Adds to slopes [W x relax_width] that of sum w (|x_i - x_j| - L)^2 / 2.
MESHREEL_WIDEST void add_slopes(std::span<const ElasticEdge> edges, const double* __restrict x,
                                double* __restrict slopes)
{
    for (const ElasticEdge& edge : edges) {
        EdgeInBlock found;
        measure_edge(edge, x, found);
        double pull[relax_lanes];
        for (std::size_t l = 0; l < relax_lanes; ++l) {
            const double length = found.length[l] > 0 ? found.length[l] : 1.0; // no direction: `along` is 0
            pull[l] = edge.weight * (1.0 - edge.length / length);
        }
        double *a = slopes + edge.i * relax_width, *b = slopes + edge.j * relax_width;
        for (std::size_t i = 0; i < relax_width; ++i) found.along[i] *= pull[i % relax_lanes];
        for (std::size_t i = 0; i < relax_width; ++i) a[i] += found.along[i];
        for (std::size_t i = 0; i < relax_width; ++i) b[i] -= found.along[i];
    }
}

/// One step of all vertices; slopes are 0 afterwards.
MESHREEL_WIDEST void step_down(std::span<const double> steps, const double* __restrict p, double* __restrict slopes,
                               double* __restrict x)
{
    for (std::size_t v = 0; v < steps.size(); ++v)
        for (std::size_t i = v * relax_width; i < (v + 1) * relax_width; ++i) {
            x[i] -= steps[v] * ((x[i] - p[i]) + slopes[i]);
            slopes[i] = 0.0;
        }
}

/// sums [K] += delta [relax_width] times the block's basis, turned: turned [relax_width x K].
MESHREEL_WIDEST void add_projected(const double* __restrict delta, const double* __restrict turned,
                                   std::span<double> sums)
{
    double* __restrict out = sums.data();
    const std::size_t K = sums.size();
    for (std::size_t i = 0; i < relax_width; ++i)
        for (std::size_t k = 0; k < K; ++k) out[k] += delta[i] * turned[i * K + k];
}

class Relaxation {
public:
    Relaxation(std::span<const Triangle> triangles, const Basis& basis, MatrixView<double> C,
               const RelaxOptions& options)
        : basis_(basis), C_(C), options_(options), frame_count_(basis.mean.size() / 3),
          blocks_((frame_count_ + relax_lanes - 1) / relax_lanes), edges_(edges_of(triangles))
    {
    }

    void run()
    {
        if (edges_.empty() || C_.cols == 0 || frame_count_ < 2) return;
        trust(lengths());
        Matrix<double> moved(C_.rows, C_.cols);
        const std::size_t run = relax_run(C_.rows);
        for (std::size_t first = 0; first < blocks_; first += run)
            add_moves(first, std::min(run, blocks_ - first), moved.view());
        for (std::size_t i = 0; i < moved.values.size(); ++i) C_.values()[i] += moved.values[i];
    }

private:
    /// Mean and variance of every edge are found from these, added block after block.
    std::vector<LengthSums> lengths() const
    {
        std::vector<LengthSums> sums(edges_.size());
        const std::size_t run = relax_run(C_.rows);
        for (std::size_t first = 0; first < blocks_; first += run) {
            std::vector<std::vector<double>> posed(std::min(run, blocks_ - first));
            parallel_for(posed.size(), options_.threads,
                         [&](std::size_t b) { posed[b] = posed_block(BlockBasis(basis_, first + b), C_); });
            if (first == 0) begin(sums, posed[0].data());
            add_run(first, posed, sums);
        }
        return sums;
    }

    void begin(std::vector<LengthSums>& sums, const double* x) const
    {
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            EdgeInBlock found;
            measure_edge(edges_[e], x, found);
            sums[e].base = found.length[0];
        }
    }

    void add_run(std::size_t first, const std::vector<std::vector<double>>& posed, std::span<LengthSums> sums) const
    {
        constexpr std::size_t share = 1024; // edges
        parallel_for((edges_.size() + share - 1) / share, options_.threads, [&](std::size_t task) {
            const std::size_t from = task * share, count = std::min(share, edges_.size() - from);
            for (std::size_t b = 0; b < posed.size(); ++b)
                add_lengths(std::span(edges_).subspan(from, count), posed[b].data(),
                            std::min(relax_lanes, frame_count_ - (first + b) * relax_lanes), sums.data() + from);
        });
    }

    /// What edges weigh, and how far vertices may step.
    void trust(const std::vector<LengthSums>& sums)
    {
        const double F = static_cast<double>(frame_count_);
        std::vector<double> variances(edges_.size());
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const double mean = sums[e].sum / F;
            edges_[e].length = sums[e].base + mean;
            variances[e] = std::max(0.0, sums[e].squares / F - mean * mean);
        }
        std::vector<double> sorted = variances;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const double noise = *middle;
        steps_.assign(C_.rows, 1.0);
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            ElasticEdge& edge = edges_[e];
            edge.weight = variances[e] > noise ? std::min(1.0, 0.5 * noise / (variances[e] - noise)) : 1.0;
            steps_[edge.i] += 2.0 * edge.weight;
            steps_[edge.j] += 2.0 * edge.weight;
        }
        for (double& step : steps_) step = 1.0 / step;
    }

    /// How far the vertices of one block go, [W x relax_width].
    std::vector<double> moves(const BlockBasis& basis) const
    {
        std::vector<double> p = posed_block(basis, C_), x = p, slopes(p.size(), 0.0);
        for (std::uint32_t round = 0; round < options_.rounds; ++round) {
            add_slopes(edges_, x.data(), slopes.data());
            step_down(steps_, p.data(), slopes.data(), x.data());
        }
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = x[i] - p[i];
        return p;
    }

    /// moved [W x K]: adds what a run of blocks moves, in their order.
    void add_moves(std::size_t first, std::size_t count, MatrixView<double> moved) const
    {
        const std::size_t K = C_.cols;
        std::vector<std::vector<double>> delta(count), turned(count);
        parallel_for(count, options_.threads, [&](std::size_t b) {
            const BlockBasis basis(basis_, first + b);
            delta[b] = moves(basis);
            turned[b].resize(relax_width * K);
            for (std::size_t k = 0; k < K; ++k)
                for (std::size_t i = 0; i < relax_width; ++i) turned[b][i * K + k] = basis.rows[k * relax_width + i];
        });
        constexpr std::size_t share = 256; // vertices
        parallel_for((C_.rows + share - 1) / share, options_.threads, [&](std::size_t task) {
            const std::size_t from = task * share, end = std::min(C_.rows, from + share);
            for (std::size_t b = 0; b < count; ++b)
                for (std::size_t v = from; v < end; ++v)
                    add_projected(delta[b].data() + v * relax_width, turned[b].data(), moved.row(v));
        });
    }

    const Basis& basis_;
    MatrixView<double> C_;
    RelaxOptions options_;
    std::size_t frame_count_, blocks_;
    std::vector<ElasticEdge> edges_;
    std::vector<double> steps_; ///< [W]
};

} // namespace

void relax(std::span<const Triangle> triangles, const Basis& basis, MatrixView<double> C, const RelaxOptions& options)
{
    if (options.rounds > 0) Relaxation(triangles, basis, C, options).run();
}

std::uint64_t relaxation_bytes(std::uint64_t W, std::uint64_t T, std::uint64_t K)
{
    constexpr std::uint64_t edge_bytes = sizeof(ElasticEdge) + sizeof(LengthSums) + 2 * sizeof(double);
    const std::uint64_t run = relax_run(W), basis = run * 2 * 8 * relax_width * K;
    return 8 * W * (K + 1) + 3 * T * edge_bytes + run * relax_vertex_bytes * W + basis;
}

} // namespace meshreel::codecs
