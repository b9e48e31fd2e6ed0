/// Cobra's steps, its choice of predictor, and the weights of LPC; encoder side.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/basis.h"

#include <cmath>

#include "meshreel/linalg/least_squares.h"

namespace meshreel::codecs {

namespace {

/// Counts roughly what residuals would cost; writes nothing.
struct CostProbe {
    static constexpr bool writes = true;
    double total_bits = 0.0;

    std::int32_t level(std::uint32_t, std::int32_t wanted)
    {
        total_bits += std::log2(1.0 + 2.0 * std::abs(static_cast<double>(wanted)));
        return wanted;
    }
};

/// The scale k that fits k i^q to Q_i best, and the error it leaves.
/// DEVIATES (8.26): least squares of relative errors; of plain ones, the last Q_i, ten thousand times the first where
/// the data end in noise, would bend the curve away from all others.
struct Fit {
    double k = 0.0, error = 0.0;
};

Fit fit_scale(std::span<const double> Q, double q)
{
    double cross = 0, square = 0;
    for (std::size_t i = 1; i <= Q.size(); ++i) {
        const double power = exact::power(static_cast<double>(i), q);
        const double relative = power / Q[i - 1];
        cross += relative;
        square += relative * relative;
    }
    return {cross / square, static_cast<double>(Q.size()) - cross * cross / square};
}

/// The exponent of the least squares fit, by scanning ever finer; multiples of 2^-16.
double fit_exponent(std::span<const double> Q)
{
    double best = 0.0;
    for (double width : {0.25, 0x1p-6, 0x1p-10, 0x1p-14}) {
        const double centre = best;
        for (int i = -16; i <= 32; ++i) {
            const double q = centre + i * width;
            if (q >= 0 && q <= 16 && fit_scale(Q, q).error < fit_scale(Q, best).error) best = q;
        }
    }
    return best;
}

} // namespace

int best_motion_order(std::span<const double> t, coding::Quantiser quantiser)
{
    int best = 1;
    double least = 0;
    for (int order = 1; order <= predict::motion_orders; ++order) {
        std::vector<double> copy(t.begin(), t.end());
        CostProbe probe;
        SeriesWalk<CostProbe>(probe, {}, t.size() / 3).code(copy, quantiser, {order, false, {}}, 0);
        if (order == 1 || probe.total_bits < least) {
            best = order;
            least = probe.total_bits;
        }
    }
    return best;
}

std::array<double, predict::linear_orders + 1> lpc_weights(MatrixView<const double> t, int order)
{
    std::array<double, predict::linear_orders + 1> weights{}, row{};
    const std::size_t F = t.cols / 3, m = static_cast<std::size_t>(order);
    // The normal equations of the set before (3.21): a line a value would be as many lines as the basis has values.
    Matrix<double> squares(m + 1, m + 1);
    std::vector<double> right(m + 1);
    for (std::size_t series = 0; series < 3 * t.rows; ++series) {
        const double* v = t.data + series * F;
        for (std::size_t f = m; f < F; ++f) {
            row[0] = 1.0;
            for (std::size_t j = 1; j <= m; ++j) row[j] = v[f - j];
            for (std::size_t i = 0; i <= m; ++i) {
                for (std::size_t j = 0; j <= m; ++j) squares(i, j) += row[i] * row[j];
                right[i] += row[i] * v[f];
            }
        }
    }
    const std::vector<double> best = linalg::least_squares(squares.view(), right);
    std::copy(best.begin(), best.end(), weights.begin());
    return weights;
}

BasisLaw basis_law(BasisCoding coding, double mean_step, std::span<const double> mean_absolute)
{
    BasisLaw law{coding, mean_step, 0.0, 0.0, 1.0};
    if (mean_absolute.empty()) return law;
    if (coding == BasisCoding::uniform) {
        double square = 0;
        for (double a : mean_absolute) square += a * a;
        law.a = mean_step / std::sqrt(square / static_cast<double>(mean_absolute.size()));
        return law;
    }
    std::vector<double> Q;
    for (double a : mean_absolute) Q.push_back(mean_step / a); // (8.25) with Q / (N_B + 1) = Q_m (8.29)
    law.q = fit_exponent(Q);
    law.k = fit_scale(Q, law.q).k; // (8.26)
    law.a = Q.front() - law.k;     // (8.27), (8.28)
    return law;
}

} // namespace meshreel::codecs
