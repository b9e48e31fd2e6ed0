/// Which vertices a vertex is interpolated from, and with which weights, as its components become known.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/parallel.h"
#include "meshreel/base/views.h"
#include "meshreel/mesh/coarse_to_fine.h"
#include "meshreel/predict/kriging.h"

namespace meshreel::codecs {

/// How the weights of a segment are found; part of the payload.
struct InterpolationLaw {
    double linear = 150.0;         ///< predict::Likeness::linear
    double squared_bend = 1.0;     ///< predict::Likeness::squared_bend
    double step = 1.0;             ///< D: the noise of all that is known
    std::uint32_t growth = 5;      ///< batches grow by so many eighths of the components known, and more: batch_end
    std::uint32_t neighbours = 16; ///< of each vertex, 1 .. Interpolation::most; fewer are faster

    /// Where a batch of components that begins at k of `all` ends. The more are known, the less a few more tell; and a
    /// last batch of little is not worth weights of its own.
    std::size_t batch_end(std::size_t k, std::size_t all) const
    {
        const std::size_t size = std::max<std::size_t>(1, k * growth / 8 + k * k / 64);
        return k + size + size / 4 < all ? k + size : all;
    }
};

/// Orders the vertices of a surface by their first components, and weighs their neighbours by all that are known.
class Interpolation {
public:
    static constexpr std::size_t most = predict::Kriging::most;

    /// first [W x 3]: the first components, which place the vertices. relevance: see relevance_of, [K].
    Interpolation(MatrixView<const double> first, std::vector<double> relevance, InterpolationLaw law, Threads threads);

    const CoarseToFine& order() const { return order_; }

    /// Where a batch of components that begins at k ends.
    std::size_t batch_end(std::size_t k) const { return law_.batch_end(k, relevance_.size()); }

    struct Weights {
        std::size_t count = 0;
        std::array<std::uint32_t, most> vertices{}; ///< nearest first
        std::array<double, most> values{};

        /// guess = sum of w_i C_i over components first .. first + guess.size() - 1.
        void apply(MatrixView<const double> C, std::size_t first, std::span<double> guess) const;
    };
    struct Near {
        double square; ///< distance in all components known
        std::uint32_t vertex;
        bool operator<(const Near& other) const
        {
            return square != other.square ? square < other.square : vertex < other.vertex;
        }
    };
    /// The vertices of a level and their candidates, while their components become known.
    struct Level {
        std::span<const std::uint32_t> vertices;
        std::size_t candidates; ///< of each vertex
        std::size_t known;      ///< components in the squares
        std::vector<Near> near; ///< [vertices x candidates] nearest first

        std::span<Near> of(std::size_t i) { return std::span(near).subspan(i * candidates, candidates); }
    };
    Level level(std::span<const std::uint32_t> vertices) const;

    /// The weights of the vertices of a level, from components 0 .. known-1 of theirs and of their neighbours'; known
    /// never falls.
    std::vector<Weights> weights(Level& level, MatrixView<const double> C, std::size_t known) const;

private:
    struct Task {
        Level& level;
        MatrixView<const double> C;
        std::size_t known;
    };
    void weigh(const Task& task, std::size_t first, predict::Kriging& kriging, std::span<Weights> result) const;
    /// Asks for what weighing the i-th vertex of the level will read.
    void fetch(std::size_t i, const Task& task) const;
    static void renew(std::span<Near> near, std::span<const double> own, const Task& task);

    CoarseToFine order_;
    std::vector<double> relevance_;
    InterpolationLaw law_;
    Threads threads_;
};

/// By how much components of energies s_k^2 count in distances: faint ones tell more than their size says. The fourth
/// root of s_2 / s_k; 1 for the first three.
std::vector<double> relevance_of(std::span<const double> energies);

} // namespace meshreel::codecs
