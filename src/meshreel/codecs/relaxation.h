/// Decoded frames drawn towards the edge lengths that they agree on, for surfaces that hardly stretch.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/basis.h"
#include "meshreel/mesh/animation.h"

namespace meshreel::codecs {

struct ElasticEdge {
    std::uint32_t i = 0, j = 0;
};

/// Moves decoded coefficients so that edges keep their lengths where those hardly vary over time: cloth keeps them far
/// better than quantisation does. The same bits on every machine and for any number of threads. The basis must outlive it.
class Relaxation {
public:
    Relaxation(std::span<const Triangle> triangles, const Basis& basis, Threads threads);

    /// The median over all edges of the variance, over time, of what lengths lack: those in C B + m against those in frames
    /// [F x 3W]. C [W x K]. Model units squared, >= 0; 0 where there are no edges.
    double noise_of(MatrixView<const double> C, MatrixView<const float> frames) const;

    /// Twice: of every edge L, the mean length, and s, its variance over the frames, from which the first time N = `noise`
    /// is taken; w = min(10, N / 2 / s) is how far the mean can be trusted. Every frame p, as it was before all, is then
    /// drawn to the least |x - p|^2 + sum w (|x_i - x_j| - L)^2: 8 steps for all vertices at once from where it is, sped
    /// up by Chebyshev's polynomials (Wang, A Chebyshev semi-iterative approach for accelerating projective and
    /// position-based dynamics, 2015). C takes what it moved times B^T, as B's rows [K x 3F] are nearly orthonormal.
    /// @cost O(F (6 W K + 16 E)), E the edges; memory: bytes().
    void relax(MatrixView<double> C, double noise) const;

    /// What relaxing allocates at most: C twice more, the edges, and some frames. W vertices, T triangles.
    static std::uint64_t bytes(std::uint64_t W, std::uint64_t T, std::uint64_t K);

private:
    struct Elastic;

    /// Frames by eights: what is made of each, and what is then done with some of them in their order.
    struct Blocks {
        std::size_t frames;
        Threads threads;

        std::size_t frames_in(std::size_t block) const;
        template <class Make, class Use>
        void in_runs(std::size_t W, const Make& make, const Use& use) const;
        template <class Body>
        void in_shares(std::size_t count, std::size_t share, const Body& body) const;
    };

    Elastic elastic(MatrixView<const double> C, double noise, double noise_in_spread) const;
    void draw(const Elastic& elastic, MatrixView<const double> decoded, MatrixView<double> C) const;

    const Basis& basis_;
    Blocks blocks_;
    std::vector<ElasticEdge> edges_;
};

} // namespace meshreel::codecs
