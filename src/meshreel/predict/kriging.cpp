/// The kriging systems of a few points, built and solved in step.
// SPDX-License-Identifier: MIT
#include "meshreel/predict/kriging.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/wide.h"

namespace meshreel::predict {

namespace {

constexpr std::size_t most = Kriging::most, lanes = Kriging::lanes;
using Lanes = Kriging::Lanes;
using Square = Kriging::Square;

/// G_ij = sum_k e_ik e_jk for j <= i, and somewhat beyond: four columns at a time.
MESHREEL_WIDE void products(const double* __restrict e, std::size_t n, std::size_t known, double* __restrict G)
{
    constexpr std::size_t columns = 4;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; j += columns) {
            double sums[columns] = {};
            for (std::size_t k = 0; k < known; ++k) {
                const double* __restrict row = e + most * k;
                for (std::size_t l = 0; l < columns; ++l) sums[l] += row[i] * row[j + l];
            }
            for (std::size_t l = 0; l < columns; ++l) G[most * i + j + l] = sums[l];
        }
}

/// Of each point: what turns its distances into units of their mean, the noise in them, and the sill.
struct Scales {
    Lanes unit, noise, sill;
};

MESHREEL_WIDE Scales scales_of(const Square& G, std::size_t n, const Likeness& likeness)
{
    Lanes sum{}, farthest{};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t l = 0; l < lanes; ++l) {
            sum[l] += std::sqrt(G[i][i][l]);
            farthest[l] = std::max(farthest[l], G[i][i][l]);
        }
    Scales scales;
    const double bend = std::sqrt(likeness.squared_bend);
    for (std::size_t l = 0; l < lanes; ++l) {
        const double distance = std::max(sum[l] / static_cast<double>(n), 1e-30);
        scales.unit[l] = 1.0 / (distance * distance);
        scales.noise[l] = likeness.nugget + likeness.noise / distance;
        const double widest = 4 * farthest[l] * scales.unit[l]; // no two neighbours are farther apart
        scales.sill[l] = 3 * (std::sqrt(likeness.squared_bend + widest) - bend) + bend;
    }
    return scales;
}

/// The covariances of the neighbours with each other, upper triangle, then two right sides: with the point, and ones.
struct System {
    std::array<std::array<Lanes, most + 2>, most> rows; ///< n of them, n + 2 wide
};

/// a - phi, for Hardy's multiquadric phi of a squared distance, of all points; the sill has c in it.
inline void smooth(const double* __restrict squares, const double* __restrict sill, double squared_bend,
                   double* __restrict values)
{
    for (std::size_t l = 0; l < lanes; ++l) values[l] = sill[l] - std::sqrt(squared_bend + std::max(squares[l], 0.0));
}

MESHREEL_WIDE void build(const Square& G, std::size_t n, const Likeness& likeness, System& system)
{
    const Scales scales = scales_of(G, n, likeness);
    const double* __restrict unit = scales.unit.data();
    Lanes squares;
    for (std::size_t i = 0; i < n; ++i) {
        const double* __restrict ii = G[i][i].data();
        for (std::size_t j = 0; j < i; ++j) {
            const double* __restrict ij = G[i][j].data(), * __restrict jj = G[j][j].data();
            double* __restrict value = system.rows[j][i].data();
            for (std::size_t l = 0; l < lanes; ++l) squares[l] = (ii[l] + jj[l] - 2 * ij[l]) * unit[l];
            smooth(squares.data(), scales.sill.data(), likeness.squared_bend, value);
            for (std::size_t l = 0; l < lanes; ++l) value[l] += likeness.linear * unit[l] * ij[l];
        }
        for (std::size_t l = 0; l < lanes; ++l) squares[l] = ii[l] * unit[l];
        smooth(squares.data(), scales.sill.data(), likeness.squared_bend, system.rows[i][n].data());
        const double bend = std::sqrt(likeness.squared_bend);
        for (std::size_t l = 0; l < lanes; ++l) {
            system.rows[i][i][l] = scales.sill[l] - bend + likeness.linear * squares[l] + scales.noise[l];
            system.rows[i][n + 1][l] = 1.0;
        }
    }
}

/// Gauss' elimination of what is below the diagonal; the diagonal is inverted.
MESHREEL_WIDE void eliminate(System& system, std::size_t n)
{
    for (std::size_t j = 0; j < n; ++j) {
        Lanes inverse, factor;
        for (std::size_t l = 0; l < lanes; ++l) inverse[l] = 1.0 / std::max(system.rows[j][j][l], 1e-9);
        const double* __restrict above = system.rows[j][0].data();
        for (std::size_t i = j + 1; i < n; ++i) {
            double* __restrict row = system.rows[i][0].data();
            for (std::size_t l = 0; l < lanes; ++l) factor[l] = above[lanes * i + l] * inverse[l];
            for (std::size_t c = lanes * i; c < lanes * (n + 2); c += lanes)
                for (std::size_t l = 0; l < lanes; ++l) row[c + l] -= factor[l] * above[c + l];
        }
        system.rows[j][j] = inverse;
    }
}

/// Turns both right sides into their solutions.
MESHREEL_WIDE void substitute(System& system, std::size_t n)
{
    for (std::size_t i = n; i-- > 0;) {
        double* __restrict x = system.rows[i][n].data(); // of both sides
        for (std::size_t l = 0; l < 2 * lanes; ++l) x[l] *= system.rows[i][i][l % lanes];
        for (std::size_t k = 0; k < i; ++k) {
            double* __restrict sides = system.rows[k][n].data();
            const double* __restrict factor = system.rows[k][i].data();
            for (std::size_t l = 0; l < lanes; ++l) sides[l] -= factor[l] * x[l];
            for (std::size_t l = 0; l < lanes; ++l) sides[lanes + l] -= factor[l] * x[lanes + l];
        }
    }
}

} // namespace

void Kriging::set(std::size_t point, std::size_t count, std::size_t known)
{
    std::array<double, most * most> G;
    products(e_.data(), count, known, G.data());
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j <= i; ++j) G_[i][j][point] = G[most * i + j];
}

std::array<Lanes, most> Kriging::weights(std::size_t count, const Likeness& likeness) const
{
    System system;
    build(G_, count, likeness, system);
    eliminate(system, count);
    substitute(system, count);
    std::array<Lanes, most> weights{};
    for (std::size_t l = 0; l < lanes; ++l) {
        double free_sum = 0, ones_sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            free_sum += system.rows[i][count][l];
            ones_sum += system.rows[i][count + 1][l];
        }
        const double lack = (1.0 - free_sum) / ones_sum; // weights of sum 1: unbiased
        for (std::size_t i = 0; i < count; ++i)
            weights[i][l] = system.rows[i][count][l] + lack * system.rows[i][count + 1][l];
    }
    return weights;
}

} // namespace meshreel::predict
