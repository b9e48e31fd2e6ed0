/// What principal component analyses of any run of frames would find, from a few trajectories; encoder side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "meshreel/base/views.h"

namespace meshreel::linalg {

/// Sums of the products of all pairs of N trajectories, prepared so that any run of frames is one difference.
class RunSpectra {
public:
    /// frames: [F x 3N], x y z of each trajectory.  @cost O(F N^2); memory O(F N^2 / 64).
    explicit RunSpectra(MatrixView<const float> frames);

    std::size_t trajectory_count() const { return N_; }

    /// s_k^2, falling, of the trajectories in frames first .. last - 1 less each frame's mean.  @cost O(N^3).
    std::vector<double> energies(std::size_t first, std::size_t last) const;

private:
    void add_frame(std::size_t f, std::vector<double>& gram) const;
    std::vector<double> gram_before(std::size_t f) const;

    MatrixView<const float> frames_; ///< must outlive it
    std::size_t N_;
    std::vector<std::vector<double>> grams_; ///< of the frames before each 64th, [N x N]
};

} // namespace meshreel::linalg
