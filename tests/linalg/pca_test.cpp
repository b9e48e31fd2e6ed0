/// PCA of trajectories on made data.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/linalg/pca.h"

using namespace meshreel;

namespace {

/// Frames whose trajectories have the given rank, with a mean.
Matrix<float> frames_of_rank(std::size_t rank, std::size_t F, std::size_t N)
{
    Random random(7);
    Matrix<double> modes(rank, 3 * F), weights(rank, N);
    for (double& x : modes.values) x = random.uniform(-1, 1);
    for (double& x : weights.values) x = random.uniform(-1, 1);
    Matrix<float> frames(F, 3 * N);
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t i = 0; i < 3 * N; ++i) {
            double sum = 5.0;
            for (std::size_t r = 0; r < rank; ++r) sum += weights(r, i / 3) * modes(r, i % 3 * F + f);
            frames(f, i) = static_cast<float>(sum);
        }
    return frames;
}

double largest_rebuilding_error(const Matrix<float>& frames, const linalg::Pca& pca)
{
    const Matrix<double> C = linalg::project(frames.view(), pca.mean, pca.basis.view(), {}).C;
    double largest = 0;
    for (std::size_t f = 0; f < frames.rows; ++f)
        for (std::size_t i = 0; i < frames.cols; ++i) {
            const std::size_t row = i % 3 * frames.rows + f;
            double sum = pca.mean[row];
            for (std::size_t k = 0; k < pca.basis.rows; ++k) sum += C(i / 3, k) * pca.basis(k, row);
            largest = std::max(largest, std::abs(sum - frames(f, i)));
        }
    return largest;
}

} // namespace

TEST(Pca, RebuildsDataOfLowRankFromThatManyComponents)
{
    for (auto [F, N] : {std::pair{5, 200}, std::pair{40, 30}, std::pair{200, 700}, std::pair{200, 500}}) {
        const Matrix<float> frames = frames_of_rank(6, F, N);
        EXPECT_LT(largest_rebuilding_error(frames, linalg::pca_of_trajectories(frames.view(), 7, {})), 1e-5);
    }
}

TEST(Pca, SingularValuesFallAndTheirSquaresSumToTheEnergy)
{
    const Matrix<float> frames = frames_of_rank(10, 12, 300);
    const linalg::Pca pca = linalg::pca_of_trajectories(frames.view(), 36, {});
    double sum = 0;
    for (std::size_t k = 0; k < pca.singular_values.size(); ++k) {
        if (k > 0) {
            EXPECT_LE(pca.singular_values[k], pca.singular_values[k - 1]);
        }
        sum += pca.singular_values[k] * pca.singular_values[k];
    }
    EXPECT_NEAR(sum, pca.energy, 1e-6 * pca.energy);
}

TEST(Pca, NoMotionAndNoSpreadHasNoComponents)
{
    Matrix<float> frames(4, 3);
    const linalg::Pca pca = linalg::pca_of_trajectories(frames.view(), 12, {});
    EXPECT_EQ(pca.basis.rows, 0u);
    EXPECT_EQ(pca.energy, 0.0);
}

TEST(Pca, IsTheSameForAnyNumberOfThreads)
{
    const Matrix<float> frames = frames_of_rank(40, 150, 3000);
    const linalg::Pca one = linalg::pca_of_trajectories(frames.view(), 30, Threads{1});
    const linalg::Pca three = linalg::pca_of_trajectories(frames.view(), 30, Threads{3});
    EXPECT_EQ(one.basis.values, three.basis.values);
    EXPECT_EQ(one.singular_values, three.singular_values);
}

TEST(Pca, WhatReplacingCoefficientsChangesIsTheSumOverAllTrajectories)
{
    Random random(11);
    constexpr std::size_t N = 1500, K = 4, n = 9;
    Matrix<double> C(N, K), D(N, K), basis(K, n);
    for (Matrix<double>* matrix : {&C, &D, &basis})
        for (double& x : matrix->values) x = random.uniform(-1, 1);
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            double off = 0;
            for (std::size_t k = 0; k < K; ++k) off += (C(i, k) - D(i, k)) * basis(k, j);
            sum += off * off;
        }
    EXPECT_NEAR(linalg::squared_distance(C.view(), D.view(), basis.view()), sum, 1e-9 * sum);
}
