/// Decoded frames drawn towards the edge lengths that they agree on, for surfaces that hardly stretch.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/basis.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::codecs {

struct RelaxOptions {
    std::uint32_t rounds = 10; ///< steps a frame, >= 0; 0 leaves everything as it is
    Threads threads = {};
};

/// Moves coefficients C [W x K] so that edges keep their lengths where those hardly vary over the frames: cloth keeps them
/// far better than quantisation does. Of an edge, the mean length L and its variance s over the frames; n, the median of
/// s, is taken for noise; w = min(1, n / 2 / (s - n)), 1 where s <= n, is what the edge's mean can be trusted. Every frame p
/// then goes `rounds` steps down |x - p|^2 + sum w (|x_i - x_j| - L)^2, and C takes (x - p) B^T, as B's rows [K x 3F] are
/// nearly orthonormal. The same bits on every machine and for any number of threads.
/// @cost O(F (3 W K + rounds E)), E the edges; memory: relaxation_bytes().
void relax(std::span<const Triangle> triangles, const Basis& basis, MatrixView<double> C, const RelaxOptions& options);

/// What relax() allocates at most: C once more, the edges, and some frames. W vertices, T triangles.
std::uint64_t relaxation_bytes(std::uint64_t W, std::uint64_t T, std::uint64_t K);

} // namespace meshreel::codecs
