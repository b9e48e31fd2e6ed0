/// The first components of all vertices along the surface: where geometry is still to be learned.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/codecs/contexts.h"
#include "meshreel/coding/mixed_levels.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/connectivity/parallelograms.h"
#include "meshreel/predict/least_squares.h"

namespace meshreel::codecs {

/// Codes components 0 .. n-1 of all vertices in the order in which Edgebreaker meets them, each predicted by the mean
/// of all its parallelograms and by what least squares has learned of how those fail.
/// @cost O(n W).
template <class Core>
class SurfaceWalk {
public:
    static constexpr std::size_t most = 3; ///< components

    SurfaceWalk(Core& core, const connectivity::Surface& surface, coding::Quantiser quantiser)
        : core_(core), surface_(surface), parallelograms_(connectivity::parallelograms(surface)), quantiser_(quantiser),
          levels_({most * columns, own_columns * own_columns, most * columns}, most)
    {
    }

    /// C [W x K], model units. Writing: originals in. Afterwards columns 0 .. n-1 hold what the decoder sees, and L
    /// [W x K] the magnitudes of their levels, up to 255.
    void code(std::size_t n, MatrixView<double> C, MatrixView<std::uint8_t> L)
    {
        missed_ = Matrix<double>(C.rows, most);
        for (std::size_t v = 0; v < C.rows && !ended(core_); ++v) {
            double own = 0;
            for (std::size_t k = 0; k < n; ++k) own = code_value({v, k, C, L}, own);
        }
    }

private:
    static constexpr std::uint32_t columns = 26, own_columns = 20;
    static constexpr std::size_t feature_count = 11;
    using Learner = predict::LeastSquares<feature_count>;

    struct Place {
        std::size_t v, k;
        MatrixView<double> C;
        MatrixView<std::uint8_t> L;

        double value(std::size_t u) const { return C(u, k); }
    };

    /// Returns what `own` is for the next component: how large this vertex' levels have been.
    double code_value(const Place& place, double own)
    {
        const auto [v, k, C, L] = place;
        const double plain = parallelogram_mean(place), near = nearby(place);
        const connectivity::Gate& gate = surface_.gates[v];
        const bool whole = gate.left.valid() && gate.right.valid() && gate.opposite.valid();
        typename Learner::Features u{};
        double guess = plain;
        if (whole) {
            u = features(place, plain);
            guess = bounded(plain + amplitude() * learners_[k].predict(u));
        }
        const auto row = static_cast<std::uint32_t>(k);
        const coding::MixedLevels<3>::Places places = {row * columns + coding::octave_column<1>(near, columns),
                                                       coding::octave_column<1>(near, own_columns) * own_columns +
                                                           coding::octave_column<1>(own, own_columns),
                                                       row * columns + coding::octave_column<1>(usual_[k], columns)};
        const std::int32_t wanted = Core::writes ? levels_.choose(places, row, quantiser_, C(v, k) - guess) : 0;
        const std::int32_t level = levels_.code(core_, places, row, wanted);
        C(v, k) = bounded(guess + quantiser_.value(level));
        missed_(v, k) = C(v, k) - plain;
        if (whole) learners_[k].learn(u, (C(v, k) - guess) / amplitude());
        const std::uint32_t size = magnitude(level);
        L(v, k) = static_cast<std::uint8_t>(std::min(size, 255u));
        usual_[k] += 0.02 * (size - usual_[k]);
        return k == 0 ? size : 0.5 * (own + size);
    }

    double amplitude() const { return 8 * quantiser_.step; }

    /// The mean of all parallelograms (8.1) that end at the vertex, or as much of one as is there.
    double parallelogram_mean(const Place& place) const
    {
        const auto all = parallelograms_.of(place.v);
        double sum = 0;
        for (const auto& p : all) sum += place.value(p.left) + place.value(p.right) - place.value(p.opposite); // (8.1)
        if (!all.empty()) return sum / static_cast<double>(all.size());
        const connectivity::Gate& gate = surface_.gates[place.v];
        if (gate.left.valid() && gate.right.valid())
            return 0.5 * (place.value(gate.left.value) + place.value(gate.right.value));
        if (gate.left.valid() || gate.right.valid())
            return place.value(gate.left.valid() ? gate.left.value : gate.right.value);
        return place.v > 0 ? place.value(place.v - 1) : 0.0;
    }

    /// The mean magnitude of the levels that the parallelograms lean on.
    double nearby(const Place& place) const
    {
        const auto all = parallelograms_.of(place.v);
        if (all.empty()) return usual_[place.k];
        std::uint32_t sum = 0;
        for (const auto& p : all)
            sum += place.L(p.left, place.k) + place.L(p.right, place.k) + place.L(p.opposite, place.k);
        return sum / (3.0 * static_cast<double>(all.size()));
    }

    /// What might tell how the plain parallelogram fails: its sides, how it failed at its corners, where the components
    /// known already went along and across the gate, the bends behind the corners, and the gate's own parallelogram.
    typename Learner::Features features(const Place& place, double plain) const
    {
        const connectivity::Gate& gate = surface_.gates[place.v];
        const std::size_t a = gate.left.value, b = gate.right.value, o = gate.opposite.value, k = place.k;
        const double va = place.value(a), vb = place.value(b), vo = place.value(o);
        double ahead = 1e-12, along = 1e-12, missed_ahead = 0, missed_along = 0;
        for (std::size_t j = 0; j < std::min(place.C.cols, most); ++j) {
            const double d = 0.5 * (place.C(a, j) + place.C(b, j)) - place.C(o, j), e = place.C(b, j) - place.C(a, j);
            const double missed = j < k ? missed_(place.v, j) : 0.0;
            ahead += d * d;
            along += e * e;
            missed_ahead += missed * d;
            missed_along += missed * e;
        }
        const double unit = 1.0 / amplitude();
        typename Learner::Features u{va - vo,
                                     vb - vo,
                                     missed_(a, k),
                                     missed_(b, k),
                                     missed_(o, k),
                                     missed_ahead / ahead * (0.5 * (va + vb) - vo),
                                     missed_along / along * (vb - va),
                                     bend(place, a),
                                     bend(place, b),
                                     bend(place, o),
                                     va + vb - vo - plain};
        for (double& value : u) value = bounded(value * unit);
        return u;
    }

    double bend(const Place& place, std::size_t u) const
    {
        const connectivity::Gate& gate = surface_.gates[u];
        if (!gate.left.valid() || !gate.right.valid() || !gate.opposite.valid()) return 0.0;
        return place.value(gate.left.value) + place.value(gate.right.value) - 2 * place.value(gate.opposite.value);
    }

    Core& core_;
    const connectivity::Surface& surface_;
    connectivity::Parallelograms parallelograms_;
    coding::Quantiser quantiser_;
    coding::MixedLevels<3> levels_;
    std::array<Learner, most> learners_;
    std::array<double, most> usual_{4, 4, 4};
    Matrix<double> missed_; ///< what the plain parallelogram missed
};

} // namespace meshreel::codecs
