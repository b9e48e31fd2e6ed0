/// Principal component analysis of the columns of a tall or wide matrix; encoder side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/progress.h"
#include "meshreel/base/views.h"

namespace meshreel::linalg {

/// A mean and an orthonormal basis of trajectories. n = 3F, N the number of trajectories.
struct Pca {
    std::vector<double> mean;            ///< m, [n]: row coord * F + f holds coordinate coord in frame f
    Matrix<double> basis;                ///< B, [K x n]: row k is the k-th eigentrajectory, unit length
    std::vector<double> singular_values; ///< s_k, [K], falling; s_k^2 sums the squared coefficients c_k over all vertices
    double residual = 0.0;               ///< squared norm of what the K components leave, sum over all trajectories
};

/// PCA of vertex trajectories. frames: [F x 3N], frame after frame, x y z of each vertex.
/// At most max_components components, fewer where the rest is zero. The same result for any number of threads.
/// @cost O(N n min(n, N)) for n or N below about 2000, O(N n K) beyond (block subspace iteration).  @source thesis 8.1.1
Pca pca_of_trajectories(MatrixView<const float> frames, std::size_t max_components, Threads threads,
                        const Progress& progress = {});

} // namespace meshreel::linalg
