/// PCA of shapes by the Gram matrix of the frames, accumulated in blocks of coordinates.
// SPDX-License-Identifier: MIT
#include "meshreel/linalg/pca_shapes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace meshreel::linalg {

namespace {

using Eigen::Index;
using Dense = Eigen::MatrixXd;

constexpr std::size_t coordinate_block = 3 * 512; // coordinates converted to double at a time
constexpr std::size_t shape_tile = 128;           // rows of the Gram matrix that one task computes

std::size_t block_count(std::size_t n)
{
    return (n + coordinate_block - 1) / coordinate_block;
}

std::vector<float> mean_shape(MatrixView<const float> frames, Threads threads)
{
    std::vector<float> mean(frames.cols);
    parallel_for(block_count(frames.cols), threads, [&](std::size_t b) {
        for (std::size_t i = b * coordinate_block; i < std::min(frames.cols, (b + 1) * coordinate_block); ++i) {
            double sum = 0;
            for (std::size_t f = 0; f < frames.rows; ++f) sum += static_cast<double>(frames(f, i));
            mean[i] = static_cast<float>(sum / static_cast<double>(frames.rows));
        }
    });
    return mean;
}

/// Rows f .. f + rows - 1 of block b, less the mean.
Dense centred(MatrixView<const float> frames, std::span<const float> mean, std::size_t b,
              std::array<std::size_t, 2> rows)
{
    const std::size_t first = b * coordinate_block, count = std::min(coordinate_block, frames.cols - first);
    Dense X(static_cast<Index>(rows[1]), static_cast<Index>(count));
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t f = 0; f < rows[1]; ++f)
            X(static_cast<Index>(f), static_cast<Index>(i)) =
                static_cast<double>(frames(rows[0] + f, first + i)) - static_cast<double>(mean[first + i]);
    return X;
}

/// X X^T, lower tiles, one task a tile: the order of summation is that of the blocks.
Dense gram(MatrixView<const float> frames, std::span<const float> mean, Threads threads)
{
    const std::size_t F = frames.rows, tiles = (F + shape_tile - 1) / shape_tile;
    Dense G = Dense::Zero(static_cast<Index>(F), static_cast<Index>(F));
    parallel_for(tiles * tiles, threads, [&](std::size_t task) {
        const std::size_t i = task / tiles * shape_tile, j = task % tiles * shape_tile;
        if (j > i) return;
        const std::size_t rows = std::min(shape_tile, F - i), cols = std::min(shape_tile, F - j);
        auto part =
            G.block(static_cast<Index>(i), static_cast<Index>(j), static_cast<Index>(rows), static_cast<Index>(cols));
        for (std::size_t b = 0; b < block_count(frames.cols); ++b)
            part.noalias() += centred(frames, mean, b, {i, rows}) * centred(frames, mean, b, {j, cols}).transpose();
    });
    return G;
}

/// Scales each column so that its largest entry is 1 in absolute value.
void scale_to_one(Dense& U)
{
    for (Index k = 0; k < U.cols(); ++k) {
        Index row = 0;
        U.col(k).cwiseAbs().maxCoeff(&row);
        U.col(k) /= U(row, k);
    }
}

/// Modes that fit the weights best, one after the other: since the columns of U are orthogonal, X^T u / |u|^2.
void project(MatrixView<const float> frames, const Dense& U, ShapeModes& result, Threads threads)
{
    const std::size_t K = result.modes.rows;
    const Dense scaled = U.leftCols(static_cast<Index>(K)) *
                         U.leftCols(static_cast<Index>(K)).colwise().squaredNorm().cwiseInverse().asDiagonal();
    parallel_for(block_count(frames.cols), threads, [&](std::size_t b) {
        const Dense M = scaled.transpose() * centred(frames, result.base, b, {0, frames.rows});
        for (Index k = 0; k < M.rows(); ++k)
            for (Index i = 0; i < M.cols(); ++i)
                result.modes(static_cast<std::size_t>(k), b * coordinate_block + static_cast<std::size_t>(i)) =
                    static_cast<float>(M(k, i));
    });
}

/// The largest distance that the first K modes leave in block b.
double block_error(MatrixView<const float> frames, const ShapeModes& result, std::size_t K, std::size_t b)
{
    Dense R = centred(frames, result.base, b, {0, frames.rows});
    const Index count = R.cols();
    using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Floats> W(result.weights.values.data(), R.rows(), static_cast<Index>(result.weights.cols));
    const Eigen::Map<const Floats> M(result.modes.values.data(), static_cast<Index>(result.modes.rows),
                                     static_cast<Index>(frames.cols));
    const Dense weights = W.leftCols(static_cast<Index>(K)).cast<double>();
    const Dense modes =
        M.block(0, static_cast<Index>(b * coordinate_block), static_cast<Index>(K), count).cast<double>();
    R.noalias() -= weights * modes;
    double largest = 0;
    for (Index v = 0; v + 2 < count; v += 3)
        largest = std::max(largest, R.middleCols(v, 3).rowwise().squaredNorm().maxCoeff());
    return std::sqrt(largest);
}

double error_with(MatrixView<const float> frames, const ShapeModes& result, std::size_t K, Threads threads)
{
    std::vector<double> errors(block_count(frames.cols));
    parallel_for(errors.size(), threads, [&](std::size_t b) { errors[b] = block_error(frames, result, K, b); });
    return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}

/// How many modes surely suffice: the rest together, all in one vertex of one frame, is within the tolerance.
std::size_t enough(const Eigen::VectorXd& falling, double tolerance)
{
    double rest = 0;
    std::size_t K = static_cast<std::size_t>(falling.size());
    while (K > 0 && rest + std::max(0.0, falling(static_cast<Index>(K) - 1)) <= tolerance * tolerance)
        rest += std::max(0.0, falling(static_cast<Index>(--K)));
    return K;
}

/// How many eigenvalues stand clear of rounding.
std::size_t shape_rank(const Eigen::VectorXd& falling)
{
    std::size_t K = 0;
    while (K < static_cast<std::size_t>(falling.size()) && falling(static_cast<Index>(K)) > falling(0) * 1e-15) ++K;
    return K;
}

void keep(ShapeModes& result, std::size_t K)
{
    const std::size_t before = result.weights.cols;
    Matrix<float> weights(result.weights.rows, K);
    for (std::size_t f = 0; f < weights.rows; ++f)
        for (std::size_t k = 0; k < K; ++k) weights(f, k) = result.weights.values[f * before + k];
    result.weights = std::move(weights);
    result.modes.rows = K;
    result.modes.values.resize(K * result.modes.cols);
    result.modes.values.shrink_to_fit();
}

/// The fewest modes within the tolerance, by halving; all that there are where none is.
std::size_t fewest(MatrixView<const float> frames, const ShapeModes& result, const ShapeOptions& options)
{
    std::size_t low = 0, high = result.modes.rows;
    for (std::size_t turn = 0; low < high; ++turn) {
        report(options.progress, "choosing modes", 1.0 - 1.0 / static_cast<double>(turn + 1));
        const std::size_t middle = (low + high) / 2;
        if (error_with(frames, result, middle, options.threads) <= options.tolerance)
            high = middle;
        else
            low = middle + 1;
    }
    return high;
}

/// Moves and scales each mode's weights to [0, 1], and the base and the modes with them.
void to_unit_range(ShapeModes& result, Threads threads)
{
    std::vector<double> lowest, range;
    for (std::size_t k = 0; k < result.modes.rows; ++k) {
        float low = result.weights(0, k), high = low;
        for (std::size_t f = 0; f < result.weights.rows; ++f) {
            low = std::min(low, result.weights(f, k));
            high = std::max(high, result.weights(f, k));
        }
        lowest.push_back(low);
        range.push_back(high > low ? static_cast<double>(high) - low : 1.0); // a constant mode goes into the base
        for (std::size_t f = 0; f < result.weights.rows; ++f)
            result.weights(f, k) = static_cast<float>((static_cast<double>(result.weights(f, k)) - low) / range[k]);
    }
    parallel_for(block_count(result.base.size()), threads, [&](std::size_t b) {
        for (std::size_t i = b * coordinate_block; i < std::min(result.base.size(), (b + 1) * coordinate_block); ++i) {
            double moved = result.base[i];
            for (std::size_t k = 0; k < result.modes.rows; ++k) {
                moved += lowest[k] * static_cast<double>(result.modes(k, i));
                result.modes(k, i) = static_cast<float>(range[k] * static_cast<double>(result.modes(k, i)));
            }
            result.base[i] = static_cast<float>(moved);
        }
    });
}

} // namespace

ShapeModes pca_of_shapes(MatrixView<const float> frames, const ShapeOptions& options)
{
    ShapeModes result;
    result.base = mean_shape(frames, options.threads);
    report(options.progress, "correlating frames", 0.0);
    const Eigen::SelfAdjointEigenSolver<Dense> solver(gram(frames, result.base, options.threads));
    const Eigen::VectorXd falling = solver.eigenvalues().reverse();
    Dense U = solver.eigenvectors().rowwise().reverse();
    const std::size_t most = options.modes > 0 ? options.modes : enough(falling, options.tolerance);
    const std::size_t K = std::min(most, shape_rank(falling));
    U.conservativeResize(Eigen::NoChange, static_cast<Index>(K));
    scale_to_one(U);
    result.weights = Matrix<float>(frames.rows, K);
    for (std::size_t f = 0; f < frames.rows; ++f)
        for (std::size_t k = 0; k < K; ++k)
            result.weights(f, k) = static_cast<float>(U(static_cast<Index>(f), static_cast<Index>(k)));
    result.modes = Matrix<float>(K, frames.cols);
    project(frames, U, result, options.threads);
    if (options.modes == 0) keep(result, fewest(frames, result, options));
    to_unit_range(result, options.threads);
    result.largest_error = error_with(frames, result, result.modes.rows, options.threads);
    return result;
}

} // namespace meshreel::linalg
