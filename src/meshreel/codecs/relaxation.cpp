/// Passes over the posed frames: what lengths are, then steps towards them.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/relaxation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshreel/base/wide.h"
#include "meshreel/codecs/length_sums.h"

namespace meshreel::codecs {

namespace {

constexpr std::size_t relax_lanes = 8;                // frames side by side: one register of AVX-512
constexpr std::size_t relax_width = 3 * relax_lanes;  // x, y, z of one vertex in all of them
constexpr std::uint64_t relax_most_run = 16;          // blocks of frames at a time
constexpr std::uint64_t relax_run_bytes = 1ull << 26; // that they should not exceed, unless two do
constexpr std::uint64_t relax_vertex_bytes =
    5ull * 8 * relax_width; // a block's places now and before, their slopes, ...
constexpr int relax_passes = 2, relax_rounds = 8;
constexpr double stiffest = 10.0; // w at most
constexpr double over_step = 1.8; // times the step that is sure to descend: what moves fastest is stiff
constexpr double slowest =
    0.95; // rho: what is left of the slowest error after a step, as Chebyshev's polynomials see it
constexpr double least_spread = 1e-30;
constexpr std::size_t edge_share = 1024, vertex_share = 256; // at a time

/// Blocks of frames at a time; what comes out does not depend on it.
std::uint64_t relax_run(std::uint64_t W)
{
    return std::clamp<std::uint64_t>(relax_run_bytes / (relax_vertex_bytes * W + 1), 2, relax_most_run);
}

/// An edge, what its length should be, and how much it should.
struct Spring {
    ElasticEdge edge;
    double length = 0.0, weight = 0.0;
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
        edges[e] = {static_cast<std::uint32_t>(keys[e] >> 32), static_cast<std::uint32_t>(keys[e])};
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

/// sums [E] take lengths in the first `count` frames of a block, in their order.
MESHREEL_WIDEST void add_lengths(std::span<const ElasticEdge> edges, const double* __restrict x, std::size_t count,
                                 LengthSums* __restrict sums)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        EdgeInBlock found;
        measure_edge(edges[e], x, found);
        for (std::size_t l = 0; l < count; ++l) sums[e].add(found.length[l]);
    }
}

/// One block as decoded and as it was.
struct TwoBlocks {
    std::vector<double> decoded, wanted;
};

/// Likewise what lengths as decoded have beyond those wanted.
MESHREEL_WIDEST void add_length_errors(std::span<const ElasticEdge> edges, const TwoBlocks& blocks, std::size_t count,
                                       LengthSums* __restrict sums)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        EdgeInBlock found, wanted;
        measure_edge(edges[e], blocks.decoded.data(), found);
        measure_edge(edges[e], blocks.wanted.data(), wanted);
        for (std::size_t l = 0; l < count; ++l) sums[e].add(found.length[l] - wanted.length[l]);
    }
}

/// Adds to slopes [W x relax_width] that of sum w (|x_i - x_j| - L)^2 / 2.
MESHREEL_WIDEST void add_slopes(std::span<const Spring> springs, const double* __restrict x, double* __restrict slopes)
{
    for (const Spring& spring : springs) {
        EdgeInBlock found;
        measure_edge(spring.edge, x, found);
        double pull[relax_lanes];
        for (std::size_t l = 0; l < relax_lanes; ++l) {
            const double length = found.length[l] > 0 ? found.length[l] : 1.0; // no direction: `along` is 0
            pull[l] = spring.weight * (1.0 - spring.length / length);
        }
        double *a = slopes + spring.edge.i * relax_width, *b = slopes + spring.edge.j * relax_width;
        for (std::size_t i = 0; i < relax_width; ++i) found.along[i] *= pull[i % relax_lanes];
        for (std::size_t i = 0; i < relax_width; ++i) a[i] += found.along[i];
        for (std::size_t i = 0; i < relax_width; ++i) b[i] -= found.along[i];
    }
}

/// Places [W x relax_width] of a block on their way: decoded, now, and one round ago.
struct Descent {
    std::vector<double> p, x, before, slopes;

    Descent(std::vector<double> decoded, std::vector<double> now)
        : p(std::move(decoded)), x(std::move(now)), before(x), slopes(x.size(), 0.0)
    {
    }
};

/// `before` becomes where x goes next: a step down the slopes, lengthened by omega; slopes are 0 afterwards.
MESHREEL_WIDEST void step_down(std::span<const double> steps, double omega, Descent& descent)
{
    const double* __restrict p = descent.p.data(), * __restrict x = descent.x.data();
    double* __restrict before = descent.before.data(), * __restrict slopes = descent.slopes.data();
    for (std::size_t v = 0; v < steps.size(); ++v)
        for (std::size_t i = v * relax_width; i < (v + 1) * relax_width; ++i) {
            const double next = x[i] - steps[v] * ((x[i] - p[i]) + slopes[i]);
            before[i] += omega * (next - before[i]);
            slopes[i] = 0.0;
        }
}

/// omega of a round from that of the round before: Chebyshev's recurrence.
constexpr double next_omega(int round, double omega)
{
    if (round == 0) return 1.0;
    return round == 1 ? 2.0 / (2.0 - slowest * slowest) : 4.0 / (4.0 - slowest * slowest * omega);
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

/// Frames of the original as a block, [W x relax_width]; those beyond the last are 0.
std::vector<double> block_of(MatrixView<const float> frames, std::size_t block)
{
    const std::size_t W = frames.cols / 3, first = block * relax_lanes,
                      count = std::min(relax_lanes, frames.rows - first);
    std::vector<double> x(W * relax_width, 0.0);
    for (std::size_t l = 0; l < count; ++l)
        for (std::size_t v = 0; v < W; ++v)
            for (std::size_t c = 0; c < 3; ++c)
                x[v * relax_width + c * relax_lanes + l] = frames.row(first + l)[3 * v + c];
    return x;
}

/// sums [E] of differences to the lengths in a block's first frame.
void begin_lengths(std::span<const ElasticEdge> edges, const double* x, LengthSums* sums)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        EdgeInBlock found;
        measure_edge(edges[e], x, found);
        sums[e].base = found.length[0];
    }
}

/// The basis of a block, [relax_width x K].
std::vector<double> turned(const BlockBasis& basis)
{
    const std::size_t K = basis.rows.size() / relax_width;
    std::vector<double> rows(basis.rows.size());
    for (std::size_t k = 0; k < K; ++k)
        for (std::size_t i = 0; i < relax_width; ++i) rows[i * K + k] = basis.rows[k * relax_width + i];
    return rows;
}

} // namespace

std::size_t Relaxation::Blocks::frames_in(std::size_t block) const
{
    return std::min(relax_lanes, frames - block * relax_lanes);
}

/// use(first, made): made[b] is what make(first + b) gave.
template <class Make, class Use>
void Relaxation::Blocks::in_runs(std::size_t W, const Make& make, const Use& use) const
{
    const std::size_t count = (frames + relax_lanes - 1) / relax_lanes, run = relax_run(W);
    for (std::size_t first = 0; first < count; first += run) {
        std::vector<decltype(make(first))> made(std::min(run, count - first));
        parallel_for(made.size(), threads, [&](std::size_t b) { made[b] = make(first + b); });
        use(first, made);
    }
}

/// body(from, count) for all of `count` things.
template <class Body>
void Relaxation::Blocks::in_shares(std::size_t count, std::size_t share, const Body& body) const
{
    parallel_for((count + share - 1) / share, threads,
                 [&](std::size_t s) { body(s * share, std::min(share, count - s * share)); });
}

/// All that edges ask of the vertices.
struct Relaxation::Elastic {
    std::vector<Spring> springs;
    std::vector<double> steps; ///< [W]

    /// Lets x run, over_step each; returns how far it went.
    std::vector<double> moves(Descent descent) const
    {
        std::vector<double> from = descent.x;
        double omega = 1.0;
        for (int round = 0; round < relax_rounds; ++round) {
            add_slopes(springs, descent.x.data(), descent.slopes.data());
            omega = next_omega(round, omega);
            step_down(steps, omega, descent);
            std::swap(descent.x, descent.before);
        }
        for (std::size_t i = 0; i < from.size(); ++i) from[i] = descent.x[i] - from[i];
        return from;
    }
};
Relaxation::Relaxation(std::span<const Triangle> triangles, const Basis& basis, Threads threads)
    : basis_(basis), blocks_{basis.mean.size() / 3, threads}, edges_(edges_of(triangles))
{
}

double Relaxation::noise_of(MatrixView<const double> C, MatrixView<const float> frames) const
{
    if (edges_.empty()) return 0.0;
    std::vector<LengthSums> sums(edges_.size());
    blocks_.in_runs(
        C.rows,
        [&](std::size_t b) {
            return TwoBlocks{posed_block(BlockBasis(basis_, b), C), block_of(frames, b)};
        },
        [&](std::size_t first, const std::vector<TwoBlocks>& run) {
            blocks_.in_shares(edges_.size(), edge_share, [&](std::size_t from, std::size_t count) {
                for (std::size_t b = 0; b < run.size(); ++b)
                    add_length_errors(std::span(edges_).subspan(from, count), run[b], blocks_.frames_in(first + b),
                                      sums.data() + from);
            });
        });
    return middle_variance(sums, static_cast<double>(blocks_.frames));
}

void Relaxation::relax(MatrixView<double> C, double noise) const
{
    if (edges_.empty() || C.cols == 0 || blocks_.frames < 2 || !(noise > 0)) return;
    Matrix<double> decoded(C.rows, C.cols);
    std::ranges::copy(C.values(), decoded.values.begin());
    for (int pass = 0; pass < relax_passes; ++pass) draw(elastic(C, noise, pass == 0 ? noise : 0.0), decoded.view(), C);
}

/// How far lengths in C B + m can be trusted, whose noise may be in their spread.
Relaxation::Elastic Relaxation::elastic(MatrixView<const double> C, double noise, double noise_in_spread) const
{
    std::vector<LengthSums> sums(edges_.size());
    blocks_.in_runs(
        C.rows, [&](std::size_t b) { return posed_block(BlockBasis(basis_, b), C); },
        [&](std::size_t first, const std::vector<std::vector<double>>& posed) {
            blocks_.in_shares(edges_.size(), edge_share, [&](std::size_t from, std::size_t count) {
                const std::span<const ElasticEdge> edges = std::span(edges_).subspan(from, count);
                if (first == 0) begin_lengths(edges, posed[0].data(), sums.data() + from);
                for (std::size_t b = 0; b < posed.size(); ++b)
                    add_lengths(edges, posed[b].data(), blocks_.frames_in(first + b), sums.data() + from);
            });
        });
    const double F = static_cast<double>(blocks_.frames);
    Elastic elastic{{}, std::vector<double>(C.rows, 1.0)};
    elastic.springs.reserve(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const double spread = std::max(sums[e].variance(F) - noise_in_spread, least_spread);
        const double weight = std::min(stiffest, 0.5 * noise / spread);
        elastic.springs.push_back({edges_[e], sums[e].mean(F), weight});
        for (const std::uint32_t v : {edges_[e].i, edges_[e].j}) elastic.steps[v] += 2.0 * weight;
    }
    for (double& step : elastic.steps) step = over_step / step;
    return elastic;
}

/// C [W x K] takes what moves of its frames the basis can say. decoded [W x K]: before all passes.
void Relaxation::draw(const Elastic& elastic, MatrixView<const double> decoded, MatrixView<double> C) const
{
    struct Moves {
        std::vector<double> delta, turned;
    };
    const std::size_t K = C.cols;
    Matrix<double> moved(C.rows, K);
    blocks_.in_runs(
        C.rows,
        [&](std::size_t b) {
            const BlockBasis basis(basis_, b);
            return Moves{elastic.moves({posed_block(basis, decoded), posed_block(basis, C)}), turned(basis)};
        },
        [&](std::size_t, const std::vector<Moves>& run) {
            blocks_.in_shares(C.rows, vertex_share, [&](std::size_t from, std::size_t count) {
                for (const Moves& moves : run)
                    for (std::size_t v = from; v < from + count; ++v)
                        add_projected(moves.delta.data() + v * relax_width, moves.turned.data(), moved.row(v));
            });
        });
    for (std::size_t i = 0; i < moved.values.size(); ++i) C.values()[i] += moved.values[i];
}

std::uint64_t Relaxation::bytes(std::uint64_t W, std::uint64_t T, std::uint64_t K)
{
    constexpr std::uint64_t edge_bytes = sizeof(ElasticEdge) + sizeof(LengthSums) + sizeof(Spring);
    const std::uint64_t run = relax_run(W), basis = run * 2 * 8 * relax_width * K;
    return 8 * W * (2 * K + 1) + 3 * T * edge_bytes + run * relax_vertex_bytes * W + basis;
}

} // namespace meshreel::codecs
