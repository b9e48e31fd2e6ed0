/// PCA by the Gram matrix of the shorter side, accumulated in blocks of vertices.
// SPDX-License-Identifier: MIT
#include "meshreel/linalg/pca.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "meshreel/base/random.h"
#include "meshreel/linalg/product.h"

namespace meshreel::linalg {

namespace {

using Eigen::Index;
using Columns = Eigen::MatrixXd; // column-major: a block of trajectories, one a column
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr Index tile = 128;         // rows of the Gram matrix that one task computes
constexpr std::size_t block = 1024; // vertices converted to double at a time

Index ceil_div(Index a, Index b)
{
    return (a + b - 1) / b;
}

std::size_t vertex_count(MatrixView<const float> frames)
{
    return frames.cols / 3;
}

/// Trajectories first .. first + count - 1 less the mean, [n x count].
Columns trajectories(MatrixView<const float> frames, std::span<const double> mean, std::size_t first, std::size_t count)
{
    const std::size_t F = frames.rows;
    Columns X(static_cast<Index>(3 * F), static_cast<Index>(count));
    for (std::size_t f = 0; f < F; ++f) {
        const float* row = frames.data + f * frames.cols + 3 * first;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t v = 0; v < count; ++v)
                X(static_cast<Index>(c * F + f), static_cast<Index>(v)) = row[3 * v + c] - mean[c * F + f];
    }
    return X;
}

std::vector<double> mean_trajectory(MatrixView<const float> frames)
{
    const std::size_t F = frames.rows, N = vertex_count(frames);
    std::vector<double> mean(3 * F, 0.0);
    for (std::size_t f = 0; f < F; ++f) {
        double sum[3] = {0, 0, 0};
        const std::span<const float> row = frames.row(f);
        for (std::size_t i = 0; i < row.size(); ++i) sum[i % 3] += row[i];
        for (std::size_t c = 0; c < 3; ++c) mean[c * F + f] = sum[c] / static_cast<double>(N);
    }
    return mean;
}

/// Of an Eigen matrix, [rows x cols]; and of its transpose.
Factor rows_of(const Columns& matrix)
{
    return {matrix.data(), static_cast<std::size_t>(matrix.rows()), 1, static_cast<std::size_t>(matrix.rows())};
}
Factor columns_of(const Columns& matrix)
{
    return {matrix.data(), static_cast<std::size_t>(matrix.cols()), static_cast<std::size_t>(matrix.rows()), 1};
}

Factor part_of(const Factor& factor, Index first, Index count)
{
    return {factor.data + static_cast<std::size_t>(first) * factor.along, static_cast<std::size_t>(count), factor.along,
            factor.across};
}

/// A B^T, depth terms each.
Columns product(const Factor& A, const Factor& B, std::size_t depth)
{
    Columns C = Columns::Zero(static_cast<Index>(A.count), static_cast<Index>(B.count));
    add_product(A, B, depth, {C.data(), A.count});
    return C;
}

/// G += A A^T, lower tiles only, one task a tile.
void add_gram(const Factor& A, std::size_t depth, Columns& G, Threads threads)
{
    const auto size = static_cast<Index>(A.count), tiles = ceil_div(size, tile);
    parallel_for(static_cast<std::size_t>(tiles * tiles), threads, [&](std::size_t task) {
        const Index i = static_cast<Index>(task) / tiles * tile, j = static_cast<Index>(task) % tiles * tile;
        if (j > i) return;
        add_product(part_of(A, i, std::min(tile, size - i)), part_of(A, j, std::min(tile, size - j)), depth,
                    {&G(i, j), A.count});
    });
}

/// X X^T, [n x n], lower triangle.
Columns gram_of_rows(MatrixView<const float> frames, std::span<const double> mean, Threads threads)
{
    const auto n = static_cast<Index>(mean.size());
    Columns G = Columns::Zero(n, n);
    for (std::size_t first = 0; first < vertex_count(frames); first += block) {
        const Columns X = trajectories(frames, mean, first, std::min(block, vertex_count(frames) - first));
        add_gram(rows_of(X), static_cast<std::size_t>(X.cols()), G, threads);
    }
    return G;
}

/// X^T X, [N x N], lower triangle; N is the shorter side, so X fits in memory.
Columns gram_of_trajectories(const Columns& X, Threads threads)
{
    Columns G = Columns::Zero(X.cols(), X.cols());
    add_gram(columns_of(X), static_cast<std::size_t>(X.rows()), G, threads);
    return G;
}

struct Eigenpairs {
    std::vector<double> values; // falling
    Columns vectors;            // [d x K], in the same order
};

Eigenpairs last_pairs_first(const Eigen::SelfAdjointEigenSolver<Columns>& solver, Index count)
{
    Eigenpairs pairs{{}, solver.eigenvectors().rightCols(count).rowwise().reverse()};
    for (Index k = 0; k < count; ++k) pairs.values.push_back(solver.eigenvalues()(solver.eigenvalues().size() - 1 - k));
    return pairs;
}

Columns orthonormal_block(const Columns& Y)
{
    const Eigen::HouseholderQR<Columns> qr(Y);
    return qr.householderQ() * Columns::Identity(Y.rows(), Y.cols());
}

/// Block Gram-Schmidt, each block cleared of those before it twice: nearly all of the work is in products.
Columns orthonormal(const Columns& Y)
{
    constexpr Index width = 32;
    const auto n = static_cast<std::size_t>(Y.rows());
    Columns Q(Y.rows(), Y.cols());
    for (Index first = 0; first < Y.cols(); first += width) {
        Columns part = Y.middleCols(first, std::min(width, Y.cols() - first));
        for (int turn = 0; turn < 2; ++turn) {
            const Columns along = -product(part_of(columns_of(Q), 0, first), columns_of(part), n);
            add_product(rows_of(Q), columns_of(along), static_cast<std::size_t>(first), {part.data(), n});
            part = orthonormal_block(part);
        }
        Q.middleCols(first, part.cols()) = part;
    }
    return Q;
}

/// S Y for symmetric S, one task a strip of columns.
Columns apply(const Columns& S, const Columns& Y, Threads threads)
{
    constexpr Index strip = 72;
    Columns Z = Columns::Zero(Y.rows(), Y.cols());
    parallel_for(static_cast<std::size_t>(ceil_div(Y.cols(), strip)), threads, [&](std::size_t task) {
        const Index first = static_cast<Index>(task) * strip, count = std::min(strip, Y.cols() - first);
        add_product(rows_of(S), part_of(columns_of(Y), first, count), static_cast<std::size_t>(S.cols()),
                    {&Z(0, first), static_cast<std::size_t>(Z.rows())});
    });
    return Z;
}

/// The leading eigenpairs by subspace iteration with a seeded start; each turn multiplies the gap between wanted and
/// unwanted directions, so a fixed number of turns is enough for a basis.
Eigenpairs leading_pairs(const Columns& S, Index count, Threads threads)
{
    constexpr Index spare = 24;
    constexpr int turns = 6;
    const auto n = static_cast<std::size_t>(S.rows());
    Random random(1);
    Columns Y(S.rows(), std::min(S.rows(), count + spare));
    for (Index i = 0; i < Y.size(); ++i) Y.data()[i] = random.uniform(-1.0, 1.0);
    for (int turn = 0; turn < turns; ++turn) Y = apply(S, orthonormal(Y), threads);
    const Columns Q = orthonormal(Y);
    const Columns SQ = apply(S, Q, threads), small = product(columns_of(Q), columns_of(SQ), n);
    Eigenpairs pairs = last_pairs_first(Eigen::SelfAdjointEigenSolver<Columns>(small), count);
    pairs.vectors = product(rows_of(Q), columns_of(pairs.vectors), static_cast<std::size_t>(Q.cols()));
    return pairs;
}

/// Eigenpairs of a symmetric matrix of which the lower triangle is given.
Eigenpairs eigenpairs(const Columns& lower, Index count, Threads threads)
{
    constexpr Index dense_below = 400;
    if (lower.rows() <= dense_below || 3 * count > lower.rows())
        return last_pairs_first(Eigen::SelfAdjointEigenSolver<Columns>(lower), count);
    return leading_pairs(lower.selfadjointView<Eigen::Lower>(), count, threads);
}

/// How many eigenvalues stand clear of rounding.
std::size_t rank_of(const std::vector<double>& values)
{
    const double floor = values.empty() ? 0.0 : std::max(values.front(), 0.0) * 1e-15;
    return static_cast<std::size_t>(std::ranges::count_if(values, [&](double value) { return value > floor; }));
}

} // namespace

Pca pca_of_trajectories(MatrixView<const float> frames, std::size_t max_components, Threads threads)
{
    Pca pca;
    pca.mean = mean_trajectory(frames);
    const std::size_t n = pca.mean.size(), N = vertex_count(frames);
    const auto wanted = static_cast<Index>(std::min({max_components, n, N}));
    const bool rows_are_shorter = n <= N;
    const Columns X = rows_are_shorter ? Columns() : trajectories(frames, pca.mean, 0, N);
    const Columns G = rows_are_shorter ? gram_of_rows(frames, pca.mean, threads) : gram_of_trajectories(X, threads);
    pca.energy = G.trace();
    const Eigenpairs pairs = eigenpairs(G, wanted, threads);
    const std::size_t K = rank_of(pairs.values);
    pca.basis = Matrix<double>(K, n);
    Eigen::Map<RowMajor> B(pca.basis.values.data(), static_cast<Index>(K), static_cast<Index>(n));
    const Factor leading = part_of(columns_of(pairs.vectors), 0, static_cast<Index>(K));
    for (std::size_t k = 0; k < K; ++k) pca.singular_values.push_back(std::sqrt(pairs.values[k]));
    if (rows_are_shorter)
        B = pairs.vectors.leftCols(static_cast<Index>(K)).transpose();
    else
        B.transpose() = orthonormal(product(rows_of(X), leading, N));
    return pca;
}

Projection project(MatrixView<const float> frames, std::span<const double> mean, MatrixView<const double> basis,
                   Threads threads)
{
    const auto K = static_cast<Index>(basis.rows);
    const std::size_t N = vertex_count(frames), tasks = (N + block - 1) / block;
    const Eigen::LDLT<Columns> normal(product(rows_of(basis), rows_of(basis), basis.cols));
    Projection result{Matrix<double>(N, basis.rows), 0.0};
    std::vector<double> errors(tasks);
    parallel_for(tasks, threads, [&](std::size_t task) {
        const std::size_t first = task * block, count = std::min(block, N - first);
        const Columns X = trajectories(frames, mean, first, count);
        errors[task] = X.squaredNorm();
        if (K == 0) return;
        const Columns inner = product(rows_of(basis), columns_of(X), basis.cols), C = normal.solve(inner);
        errors[task] -= inner.cwiseProduct(C).sum();
        Eigen::Map<RowMajor>(result.C.values.data() + first * basis.rows, static_cast<Index>(count), K) = C.transpose();
    });
    for (double error : errors) result.squared_error += error;
    return result;
}

double squared_distance(MatrixView<const double> C, MatrixView<const double> D, MatrixView<const double> basis)
{
    if (basis.rows == 0) return 0.0;
    const auto K = static_cast<Index>(C.cols);
    Columns G = Columns::Zero(K, K);
    Matrix<double> off(std::min(C.rows, std::size_t{block}), C.cols);
    for (std::size_t first = 0; first < C.rows; first += block) {
        const std::size_t count = std::min(C.rows - first, std::size_t{block}), at = first * C.cols;
        std::transform(C.data + at, C.data + at + count * C.cols, D.data + at, off.values.begin(), std::minus());
        const Factor part = columns_of({off.values.data(), count, C.cols});
        add_product(part, part, count, {G.data(), C.cols});
    }
    return product(rows_of(basis), rows_of(basis), basis.cols).cwiseProduct(G).sum();
}

std::vector<double> mean_absolute(MatrixView<const double> C)
{
    std::vector<double> mean(C.cols, 0.0);
    for (std::size_t v = 0; v < C.rows; ++v)
        for (std::size_t k = 0; k < C.cols; ++k) mean[k] += std::abs(C(v, k));
    for (double& value : mean) value /= static_cast<double>(C.rows);
    return mean;
}

} // namespace meshreel::linalg
