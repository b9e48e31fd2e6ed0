/// The PCA basis as bits: raw, uniformly quantised, Cobra (thesis 8.4, 8.5) or LPC (3.1.10). One walk for both directions.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/exact.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/contexts.h"
#include "meshreel/codecs/settings.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/predict/linear.h"
#include "meshreel/predict/motion.h"

namespace meshreel::codecs {

/// How the steps of the basis follow from a few numbers, so that both sides know them. Q_i = k i^q + a.
struct BasisLaw {
    BasisCoding coding = BasisCoding::cobra;
    double mean_step = 1.0; ///< Q_m, model units (8.29)
    double k = 0.0;         ///< (8.26); 0 for uniform
    double q = 0.0;         ///< exponent, a multiple of 2^-16 in [0, 64]
    double a = 1.0;         ///< the shift of (8.28); for uniform the one step

    /// Q_i, i = 1 .. K.  @source thesis (8.26)-(8.28)
    double step(std::size_t i) const { return k * exact::power(static_cast<double>(i), q) + a; }
};

/// A basis and the mean that goes with it; what is coded, and afterwards what the decoder sees.
struct Basis {
    std::vector<double> mean; ///< m, [3F]
    Matrix<double> rows;      ///< B, [K x 3F]
};

/// The steps for given data. mean_step: Q_m. mean_absolute: a_i of (8.24), [K], model units.
/// @source thesis (8.25)-(8.29)
BasisLaw basis_law(BasisCoding coding, double mean_step, std::span<const double> mean_absolute);

/// Predicts the next value of one coordinate of a trajectory.
struct SeriesPredictor {
    int order = 0;                                            ///< how many values before it are looked at
    bool weighted = false;                                    ///< by weights (LPC), or as a motion (Cobra)
    std::array<double, predict::linear_orders + 1> weights{}; ///< a_0 .. a_order of (3.21)

    /// The value at v, of which `known` values before are known.
    /// DEVIATES (Algorithm 1): the first values are predicted by as many as are known, not stored whole
    double guess(const double* v, std::size_t known) const
    {
        if (static_cast<std::size_t>(order) > known) return predict::motion(v, static_cast<int>(known));
        return weighted ? predict::linear(v, order, weights.data()) : predict::motion(v, order);
    }
};

/// The order of LPC, 0 for what is none.
constexpr int lpc_order(BasisCoding coding)
{
    return coding < BasisCoding::lpc1 ? 0 : 1 + static_cast<int>(coding) - static_cast<int>(BasisCoding::lpc1);
}

/// The weights a_0 .. a_order that predict trajectories t [n x 3F] best: one set for all, least squares over the whole
/// sequences before quantisation.  @source thesis 3.1.10, 8.5
std::array<double, predict::linear_orders + 1> lpc_weights(MatrixView<const double> t, int order);

/// The order of the predictor (1 .. 4) that leaves the cheapest residuals on trajectory t [3F].
int best_motion_order(std::span<const double> t, coding::Quantiser quantiser);

/// The rows of contexts that code_basis uses: three coordinates of the mean, three of the basis.
constexpr std::uint32_t basis_context_rows = 6;

/// Codes one coordinate v [F] of a trajectory; afterwards v holds what the decoder will see.
/// @source thesis Algorithm 1
template <class Coder>
class SeriesWalk {
public:
    SeriesWalk(Coder& coder, ContextGrid grid, std::size_t frame_count)
        : coder_(coder), grid_(grid), levels_(frame_count, 0)
    {
    }

    /// Codes a trajectory t [3F], its three coordinates one after the other, in rows row .. row + 2.
    void code(std::span<double> t, coding::Quantiser quantiser, const SeriesPredictor& predictor, std::uint32_t row)
    {
        const std::size_t F = levels_.size();
        std::fill(levels_.begin(), levels_.end(), 0);
        for (std::uint32_t c = 0; c < 3; ++c) code_coordinate(t.subspan(c * F, F), quantiser, predictor, row + c);
    }

private:
    void code_coordinate(std::span<double> v, coding::Quantiser quantiser, const SeriesPredictor& predictor,
                         std::uint32_t row)
    {
        for (std::size_t f = 0; f < v.size(); ++f) {
            const double guess = predictor.guess(v.data() + f, f);
            const std::int32_t wanted = Coder::writes ? quantiser.level(v[f] - guess) : 0;
            levels_[f] = coder_.level(grid_.index(row, nearby(f)), wanted);
            v[f] = guess + quantiser.value(levels_[f]);
        }
    }

    /// Residuals of the two frames before, and of this frame in the coordinate before.
    std::uint32_t nearby(std::size_t f) const
    {
        return 2 * magnitude(f > 0 ? levels_[f - 1] : 0) + magnitude(f > 1 ? levels_[f - 2] : 0) +
               2 * magnitude(levels_[f]);
    }

    Coder& coder_;
    ContextGrid grid_;
    std::vector<std::int32_t> levels_;
};

constexpr int weight_bits = 20; ///< of a weight, two's complement, raw
/// a_j, j > 0, is a multiple of it in [-8, 8); a_0 a multiple of the step of the first vector it is used for.
constexpr double weight_unit = 0x1p-16;

/// Codes the weights that predict trajectories t [n x 3F]: order + 1 raw numbers. Writing: weights are chosen; what is
/// returned is what both sides use.
template <class Coder>
SeriesPredictor code_weights(Coder& coder, int order, MatrixView<const double> t, coding::Quantiser quantiser)
{
    constexpr std::int32_t half = 1 << (weight_bits - 1);
    SeriesPredictor predictor{order, true, {}};
    if (Coder::writes) predictor.weights = lpc_weights(t, order);
    for (int j = 0; j <= order; ++j) {
        const coding::Quantiser unit{j == 0 ? quantiser.step : weight_unit};
        const std::int32_t wanted = std::clamp(unit.level(predictor.weights[j]), -half, half - 1);
        const std::int32_t stored = coder.bits(wanted & (2 * half - 1), weight_bits);
        predictor.weights[j] = unit.value(stored >= half ? stored - 2 * half : stored);
    }
    return predictor;
}

/// Codes what predicts vectors: nothing; the order of a motion, for each; weights, for the mean and for all others.
template <class Coder>
class PredictorWalk {
public:
    PredictorWalk(Coder& coder, BasisCoding coding) : coder_(coder), coding_(coding) {}

    /// The predictor of vector i, 0 the mean. basis: writing: vectors from i on still as they were.
    const SeriesPredictor& next(std::size_t i, const Basis& basis, coding::Quantiser quantiser)
    {
        const std::span<const double> t = i == 0 ? std::span<const double>(basis.mean) : basis.rows.row(i - 1);
        const int order = lpc_order(coding_);
        if (order > 0 && i <= 1)
            present_ = code_weights(coder_, order, {t.data(), i == 0 ? 1 : basis.rows.rows, t.size()}, quantiser);
        if (coding_ == BasisCoding::cobra)
            present_.order = 1 + coder_.symbol(0, Coder::writes ? best_motion_order(t, quantiser) - 1 : 0);
        return present_;
    }

private:
    Coder& coder_;
    BasisCoding coding_;
    SeriesPredictor present_;
};

/// Codes the mean and all K basis vectors by the law; afterwards `basis` holds what the decoder will see.
/// Level contexts: basis_context_rows of the grid. Symbol context 0: the orders, alphabet predict::motion_orders.
template <class Coder>
void code_basis(Coder& coder, const BasisLaw& law, ContextGrid grid, Basis& basis)
{
    SeriesWalk<Coder> walk(coder, grid, basis.mean.size() / 3);
    PredictorWalk<Coder> predictors(coder, law.coding);
    for (std::size_t i = 0; i <= basis.rows.rows; ++i) {
        const std::span<double> t = i == 0 ? std::span<double>(basis.mean) : basis.rows.row(i - 1);
        const coding::Quantiser quantiser{i == 0 ? law.mean_step : law.step(i)};
        walk.code(t, quantiser, predictors.next(i, basis, quantiser), i == 0 ? 0 : 3);
        if (ended(coder)) return;
    }
}

} // namespace meshreel::codecs
