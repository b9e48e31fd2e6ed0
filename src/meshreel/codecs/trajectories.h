/// From coefficients and a basis to frames: what every PCA codec's decoder ends with.
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/basis.h"
#include "meshreel/mesh/frame_mix.h"

namespace meshreel::codecs {

/// Trajectories in the terms of a basis: what a PCA codec decodes to. Any frame can be posed from it (8.2).
struct Trajectories {
    Basis basis;
    Matrix<double> C; ///< coefficients [W x K]
};

/// Whether all that is made of them stays within float32, mixes of frames too.
bool float_holds(const Trajectories& trajectories);

/// t = m + sum_k c_k B_k for every vertex, k rising, in double, rounded once to float32: the same on every machine.
/// frames [F x 3W].
/// @cost O(W F K).  @source thesis (8.2)
void rebuild(const Trajectories& trajectories, MatrixView<float> frames, Threads threads);

/// Frames mixed from those of the trajectories, before rounding, into frames [N x 3W]: it is the basis that is mixed, at
/// K numbers a frame instead of 3W. A mix of one frame alone gives what rebuild() rounds, bit for bit.
/// @cost O(W N K).
void pose(const Trajectories& trajectories, const Mixes& mixes, MatrixView<double> frames, Threads threads);

} // namespace meshreel::codecs
