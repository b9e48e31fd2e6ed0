/// Principal component analysis of the frames of an animation: a base shape, modes, and a weight a frame and mode.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/progress.h"
#include "meshreel/base/views.h"

namespace meshreel::linalg {

/// frame f = base + sum_k weights(f, k) modes(k, .). n = 3N, N the number of vertices. Weights lie in [0, 1], because
/// players that know sliders cut off what lies outside: the base is the mean shape moved along the modes to their ends.
struct ShapeModes {
    std::vector<float> base;    ///< [n]
    Matrix<float> modes;        ///< [K x n], model units; the most important first
    Matrix<float> weights;      ///< [F x K], each mode's smallest is 0, its largest 1
    double largest_error = 0.0; ///< the largest distance of a vertex from where it should be, model units
};

struct ShapeOptions {
    std::size_t modes = 0; ///< K; fewer where the rest is zero. 0: as few as the tolerance allows
    double tolerance =
        0.0; ///< largest distance of a vertex from where it should be, model units, >= 0; where modes is 0
    Threads threads;
    Progress progress;
};

/// PCA in the space of shapes, by the F x F Gram matrix of the frames. What it returns is measured as it is returned,
/// rounded to float32. The same result for any number of threads. Memory: one F x F matrix of doubles and the result.
/// @param frames  [F x n], frame after frame, x y z of each vertex.  @cost O(n F^2 + F^3 + n F K log F)
ShapeModes pca_of_shapes(MatrixView<const float> frames, const ShapeOptions& options);

} // namespace meshreel::linalg
