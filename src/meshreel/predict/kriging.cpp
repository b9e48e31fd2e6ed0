/// The kriging system, built in rows that vectorise and solved by Cholesky's method.
// SPDX-License-Identifier: MIT
#include "meshreel/predict/kriging.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/wide.h"

namespace meshreel::predict {

namespace {

constexpr std::size_t most = Kriging::most, lanes = 4;
using Square = std::array<std::array<double, most>, most>;
using Column = std::array<double, most>;

/// G_ij = sum_k e_ik e_jk for j <= i, and somewhat beyond: four columns at a time.
MESHREEL_WIDE void products(const double* __restrict e, std::size_t known, Square& G)
{
    for (std::size_t i = 0; i < most; ++i)
        for (std::size_t j = 0; j <= i; j += lanes) {
            double sums[lanes] = {};
            for (std::size_t k = 0; k < known; ++k) {
                const double* __restrict row = e + most * k;
                for (std::size_t l = 0; l < lanes; ++l) sums[l] += row[i] * row[j + l];
            }
            for (std::size_t l = 0; l < lanes; ++l) G[i][j + l] = sums[l];
        }
}

/// Hardy's multiquadric sqrt(c^2 + r^2) - c of squared distances, in place.
MESHREEL_WIDE void multiquadric(std::span<double> squares, double squared_bend)
{
    const double bend = std::sqrt(squared_bend);
    for (double& s : squares) s = std::sqrt(squared_bend + std::max(s, 0.0)) - bend;
}

/// The covariances of the neighbours with each other, then two right sides: with the point, and ones.
struct System {
    static constexpr std::size_t width = most + lanes, with_point = most, ones = most + 1;
    std::array<std::array<double, width>, most> rows; ///< upper triangle only
};

System system_of(const Square& G, std::size_t n, const Likeness& likeness)
{
    double distance = 0;
    for (std::size_t i = 0; i < n; ++i) distance += std::sqrt(G[i][i]);
    distance = std::max(distance / static_cast<double>(n), 1e-30);
    const double unit = 1.0 / (distance * distance), noise = likeness.nugget + likeness.noise / distance;
    std::array<double, most*(most + 1) / 2 + 1> phi; // of i and the point, then of i and j < i, then a bound of all
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) phi[count++] = G[i][i] * unit;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) phi[count++] = (G[i][i] + G[j][j] - 2 * G[i][j]) * unit;
    double farthest = 0;
    for (std::size_t i = 0; i < n; ++i) farthest = std::max(farthest, G[i][i]);
    phi[count++] = 4 * farthest * unit; // no two neighbours are farther apart
    multiquadric(std::span(phi).first(count), likeness.squared_bend);
    const double sill = 3 * phi[count - 1];
    System system{};
    count = n; // the pairs'

    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) system.rows[j][i] = sill - phi[count++] + likeness.linear * unit * G[i][j];
        system.rows[i][i] = sill + likeness.linear * unit * G[i][i] + noise;
        system.rows[i][System::with_point] = sill - phi[i];
        system.rows[i][System::ones] = 1.0;
    }
    return system;
}

/// Cholesky's U of A = U^T U in place, its diagonal inverted, and U^-T of the right sides.
MESHREEL_WIDE void eliminate(System& system, std::size_t n)
{
    for (std::size_t j = 0; j < n; ++j) {
        const double scale = 1.0 / std::sqrt(std::max(system.rows[j][j], 1e-9));
        double* __restrict above = system.rows[j].data();
        for (std::size_t c = 0; c < System::width; ++c) above[c] *= scale;
        above[j] = scale;
        for (std::size_t i = j + 1; i < n; ++i) {
            const double factor = above[i];
            double* __restrict row = system.rows[i].data();
            for (std::size_t c = i / lanes * lanes; c < System::width; c += lanes)
                for (std::size_t l = 0; l < lanes; ++l) row[c + l] -= factor * above[c + l];
        }
    }
}

/// U^-1 of a right side.
Column substitute(const System& system, std::size_t n, std::size_t side)
{
    Column x{};
    for (std::size_t i = n; i-- > 0;) {
        double sum = system.rows[i][side];
        for (std::size_t k = i + 1; k < n; ++k) sum -= system.rows[i][k] * x[k];
        x[i] = sum * system.rows[i][i];
    }
    return x;
}

} // namespace

std::array<double, most> Kriging::weights(std::size_t count, std::size_t known, const Likeness& likeness) const
{
    Square G;
    products(e_.data(), known, G);
    System system = system_of(G, count, likeness);
    eliminate(system, count);
    const Column free = substitute(system, count, System::with_point), ones = substitute(system, count, System::ones);
    double free_sum = 0, ones_sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        free_sum += free[i];
        ones_sum += ones[i];
    }
    const double lack = (1.0 - free_sum) / ones_sum; // weights of sum 1: unbiased
    Column weights{};
    for (std::size_t i = 0; i < count; ++i) weights[i] = free[i] + lack * ones[i];
    return weights;
}

} // namespace meshreel::predict
