/// Principal component analysis of trajectories; encoder side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"

namespace meshreel::linalg {

/// A mean and an orthonormal basis of the space of trajectories; n = 3F. Row c F + f of a trajectory holds coordinate
/// c (0 x, 1 y, 2 z) in frame f.
struct Pca {
    std::vector<double> mean;            ///< m, [n]
    Matrix<double> basis;                ///< B, [K x n]: row k is the k-th eigentrajectory, of unit length
    std::vector<double> singular_values; ///< s_k, [K], falling; s_k^2 is the sum of squared coefficients c_k
    double energy = 0.0;                 ///< squared norm of all trajectories less the mean
};

/// PCA of the trajectories of N vertices. frames: [F x 3N], frame after frame, x y z of each vertex. At most
/// max_components components, fewer where the rest is zero to double precision. The same result for any number of
/// threads.
/// @cost O(N n d + d^2 K), d = min(n, N); memory O(d^2 + n K) beside the frames.  @source thesis 8.1.1
Pca pca_of_trajectories(MatrixView<const float> frames, std::size_t max_components, Threads threads);

/// Trajectories in the terms of a basis.
struct Projection {
    Matrix<double> C;           ///< coefficients, [N x K]
    double squared_error = 0.0; ///< what the basis cannot express, summed over all trajectories
};

/// Coefficients of every trajectory in a basis that need not be orthonormal: least squares, c = (B B^T)^-1 B (t - m).
/// mean [n], basis [K x n]. The same result for any number of threads.
/// @cost O(N n K).
Projection project(MatrixView<const float> frames, std::span<const double> mean, MatrixView<const double> basis,
                   Threads threads);

/// Sum over all trajectories of |B^T (c - d)|^2: what replacing coefficients C by D [N x K] changes.
double squared_distance(MatrixView<const double> C, MatrixView<const double> D, MatrixView<const double> basis);

/// The mean of |c_k| over all trajectories, [K].  @source thesis (8.24)
std::vector<double> mean_absolute(MatrixView<const double> C);

} // namespace meshreel::linalg
