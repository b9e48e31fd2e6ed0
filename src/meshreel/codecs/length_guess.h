/// Guesses corrected in all frames, so that a vertex keeps its distances to neighbours where those hardly vary.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/basis.h"
#include "meshreel/codecs/interpolation.h"

namespace meshreel::codecs {

/// What is interpolated over cloth cuts its folds short: distances that hardly vary over time are known better than the
/// places. Knows the trajectories of all vertices given to it. The same bits on every machine and for any number of
/// threads. The basis must outlive it.
class LengthGuess {
public:
    LengthGuess(const Basis& basis, std::size_t vertex_count, Threads threads);

    /// Components first .. last-1, the next to be coded.
    struct Batch {
        std::size_t first = 0, last = 0;
    };

    /// All components of these vertices are known now. C [W x K].
    void know(std::span<const std::uint32_t> vertices, MatrixView<const double> C);

    /// What to add to interpolated components of these vertices, [vertices x (last - first)]. The components known, and
    /// interpolated all others, give places p in every frame. To each of the nearest 12 neighbours y_j, known, L_j is the
    /// mean of the distances, s_j their variance, S the second least variance, w_j = 8 min(3, S / s_j). x = p goes 8 steps
    /// down |x - p|^2 + sum w_j (|x - y_j| - L_j)^2, and after the fourth gives up what the known components do not allow.
    /// What comes out is (x - p) B^T. Nothing for a vertex of fewer than two neighbours.
    /// @cost O(F (K + last - first + 12 * 8)) a vertex.
    Matrix<double> corrections(std::span<const std::uint32_t> vertices, std::span<const Interpolation::Weights> weights,
                               MatrixView<const double> C, Batch batch) const;

    /// Products a coordinate that one batch costs, nearly.
    static std::uint64_t terms(std::uint64_t K);

    /// What it allocates at most: trajectories, and corrections. W vertices, F frames, K components.
    static std::uint64_t bytes(std::uint64_t W, std::uint64_t F, std::uint64_t K);

private:
    struct Guess;
    void pose(std::span<const double> c, std::span<double> place) const;
    void correct(Guess& guess, const Interpolation::Weights& near, std::size_t first) const;
    void descend(Guess& guess, const Interpolation::Weights& near) const;

    const Basis& basis_;
    Threads threads_;
    Matrix<double> places_; ///< [W x 3F]
};

} // namespace meshreel::codecs
