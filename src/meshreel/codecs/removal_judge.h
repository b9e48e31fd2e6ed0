/// What it costs, in bits or in accuracy, that a vertex goes and is interpolated later.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/connectivity/hole.h"
#include "meshreel/connectivity/surface.h"

namespace meshreel::codecs {

/// What decides who goes first.
/// DEVIATES (8.2): by price too, na keeps what is smaller: the best predicted are those of whom least is to be saved.
enum class RemovalOrder {
    accuracy, ///< how well a vertex is predicted from its ring
    price     ///< how many bits more its removal takes, those of the parallelograms round it counted
};

/// Judges by unquantised coefficients; the smaller the better.
/// The components that are judged, and the step that predictors are told, are those that a KG error of about 0.2 %
/// would need: the plan must not depend on what is asked for.
class RemovalJudge {
public:
    /// C [W x K], model units; must outlive the judge.
    explicit RemovalJudge(MatrixView<const float> C);

    /// The sum of what is missed of each component: which vertex first, where all of them are to go.
    template <class Predictor>
    double inaccuracy(Predictor& predictor, std::uint32_t v, std::span<const std::uint32_t> ring)
    {
        double sum = 0;
        const std::span<double> missed = misses(predictor, v, ring);
        for (const double miss : missed) sum += miss < 0 ? -miss : miss;
        return sum;
    }

    /// Bits of v's residuals as the predictor's, less what the parallelograms save without v.
    template <class Predictor>
    double price(Predictor& predictor, const connectivity::Mesh& mesh, std::uint32_t v, const connectivity::Hole& hole)
    {
        const double own = bits(misses(predictor, v, hole.ring));
        return own + parallelograms(mesh, v, hole.triangles) - parallelograms(mesh, v, star(mesh, v));
    }

    /// Bits of an average vertex at its gate.
    double usual_bits(std::span<const connectivity::Gate> gates);

    double step() const { return step_; }

private:
    /// Of each judged component of v, the last first.
    template <class Predictor>
    std::span<double> misses(Predictor& predictor, std::uint32_t v, std::span<const std::uint32_t> ring)
    {
        predictor.start(ring.size());
        const std::span<const double> y = std::span(y_).first(ring.size());
        for (std::size_t k = missed_.size(); k-- > 0;) {
            for (std::size_t i = 0; i < ring.size(); ++i) y_[i] = C_(ring[i], k);
            const double value = C_(v, k);
            missed_[k] = predictor.guess(y) - value;
            predictor.learn(y, value);
        }
        return missed_;
    }

    /// About what residuals take.
    double bits(std::span<const double> missed) const;
    std::span<const Triangle> star(const connectivity::Mesh& mesh, std::uint32_t v);
    /// A third of the bits of all parallelograms over the edges of a patch where v is or was: every edge has one, whichever
    /// of its ends is coded, and there are three edges a vertex.
    double parallelograms(const connectivity::Mesh& mesh, std::uint32_t v, std::span<const Triangle> patch);
    /// Bits of a parallelogram (8.1) that has left and right on its diagonal.
    double parallelogram(std::uint32_t left, std::uint32_t right, std::uint32_t tip, std::uint32_t opposite);

    MatrixView<const float> C_;
    double step_ = 1.0;
    std::vector<double> missed_; ///< [components judged]
    std::vector<Triangle> star_;
    std::array<double, connectivity::largest_ring> y_{};
};

} // namespace meshreel::codecs
