/// The matrix product of the decoder, in blocks of vertices that stay in cache.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/trajectories.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/wide.h"

namespace meshreel::codecs {

namespace {

constexpr std::size_t pose_block = 128; // vertices

/// sums[v] = m + sum_k b[k * stride] * Ct[k][v] for one row of the trajectories of a block.
struct PosedRow {
    double mean;
    MatrixView<const double> B; ///< [K x 3F], K may be 0
    std::size_t row;
};

MESHREEL_WIDE void add_up(const PosedRow& row, const double* __restrict Ct, double* __restrict sums)
{
    for (std::size_t v = 0; v < pose_block; ++v) sums[v] = row.mean;
    for (std::size_t k = 0; k < row.B.rows; ++k) {
        const double b = row.B(k, row.row);
        const double* __restrict c = Ct + k * pose_block;
        for (std::size_t v = 0; v < pose_block; ++v) sums[v] += b * c[v]; // (8.2)
    }
}

/// Ct [K x pose_block]: coefficients of vertices first .. first + count - 1, component by component; the rest zero.
std::vector<double> transposed(MatrixView<const double> C, std::size_t first, std::size_t count)
{
    std::vector<double> Ct(C.cols * pose_block, 0.0);
    for (std::size_t v = 0; v < count; ++v)
        for (std::size_t k = 0; k < C.cols; ++k) Ct[k * pose_block + v] = C(first + v, k);
    return Ct;
}

template <class Number>
void rebuild_as(const Basis& basis, MatrixView<const double> C, MatrixView<Number> frames, Threads threads)
{
    const std::size_t W = frames.cols / 3, F = frames.rows;
    parallel_for((W + pose_block - 1) / pose_block, threads, [&](std::size_t task) {
        const std::size_t first = task * pose_block, count = std::min(pose_block, W - first);
        const std::vector<double> Ct = transposed(C, first, count);
        double sums[pose_block];
        for (std::size_t f = 0; f < F; ++f)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t row = c * F + f;
                add_up({basis.mean[row], basis.rows.view(), row}, Ct.data(), sums);
                Number* out = frames.row(f).data() + 3 * first + c;
                for (std::size_t v = 0; v < count; ++v) out[3 * v] = static_cast<Number>(sums[v]);
            }
    });
}

/// One trajectory [3F] at other times [3N].
void mix_trajectory(std::span<const double> from, const Mixes& mixes, std::span<double> to)
{
    const std::size_t F = from.size() / 3, N = mixes.wanted.size();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < N; ++i) {
            double sum = -0.0; // unlike 0, it changes nothing that is added to it
            for (const FrameMix::Part& part : mixes.wanted[i].used())
                if (part.frame >= mixes.first && part.frame - mixes.first < F)
                    sum += part.weight * from[c * F + part.frame - mixes.first];
            to[c * N + i] = sum;
        }
}

constexpr double most_position = 1e36; // mixes of frames overshoot by 64 at most: float32 holds them

/// The largest of some numbers without their signs; no number where one of them is none.
double largest(std::span<const double> numbers)
{
    double most = 0.0;
    for (const double x : numbers)
        if (!(std::abs(x) <= most) && most == most) most = std::abs(x);
    return most;
}

} // namespace

bool float_holds(const Trajectories& trajectories)
{
    const auto& [mean, rows] = trajectories.basis;
    const double coefficient = largest(trajectories.C.values);
    double bound = largest(mean);
    for (std::size_t k = 0; k < rows.rows; ++k) bound += coefficient * largest(rows.row(k));
    return coefficient <= most_position && largest(rows.values) <= most_position && bound <= most_position;
}

void rebuild(const Trajectories& trajectories, MatrixView<float> frames, Threads threads)
{
    rebuild_as(trajectories.basis, trajectories.C.view(), frames, threads);
}

void pose(const Trajectories& trajectories, const Mixes& mixes, MatrixView<double> frames, Threads threads)
{
    const std::size_t N = mixes.wanted.size(), K = trajectories.basis.rows.rows;
    Basis basis{std::vector<double>(3 * N), Matrix<double>(K, 3 * N)};
    mix_trajectory(trajectories.basis.mean, mixes, basis.mean);
    for (std::size_t k = 0; k < K; ++k) mix_trajectory(trajectories.basis.rows.row(k), mixes, basis.rows.row(k));
    rebuild_as(basis, trajectories.C.view(), frames, threads);
}

} // namespace meshreel::codecs
