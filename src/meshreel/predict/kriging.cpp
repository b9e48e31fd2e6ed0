/// The kriging system, built in rows that vectorise and solved by Cholesky's method.
// SPDX-License-Identifier: MIT
#include "meshreel/predict/kriging.h"

#include <algorithm>
#include <cmath>

namespace meshreel::predict {

namespace {

constexpr std::size_t most = Kriging::most;
using Square = std::array<std::array<double, most>, most>;
using Column = std::array<double, most>;

// Wider registers change nothing in the result: every sum has its own place and its own order.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define MESHREEL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MESHREEL_WIDE
#endif

/// plain_ij = sum_k e_ik e_jk, relevant_ij = sum_k g_k e_ik e_jk.
MESHREEL_WIDE void products(const double* __restrict e, std::span<const double> g, Square& plain, Square& relevant)
{
    for (std::size_t i = 0; i < most; ++i)
        for (std::size_t j = 0; j < most; ++j) plain[i][j] = relevant[i][j] = 0.0;
    for (std::size_t k = 0; k < g.size(); ++k) {
        const double* __restrict row = e + most * k;
        for (std::size_t i = 0; i < most; ++i) {
            const double a = row[i], b = g[k] * row[i];
            for (std::size_t j = 0; j < most; ++j) plain[i][j] += a * row[j];
            for (std::size_t j = 0; j < most; ++j) relevant[i][j] += b * row[j];
        }
    }
}

/// phi(r) = r^1.75 of squared distances, in place: r^2 / (r^2)^(1/8).
MESHREEL_WIDE void radial(double* __restrict squares, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        const double s = std::max(squares[i], 1e-30);
        squares[i] = s / std::sqrt(std::sqrt(std::sqrt(s))); // (8.7)
    }
}

/// Lower triangle of the Cholesky factor in place, its diagonal inverted.
void factorise(Square& A, std::size_t n)
{
    for (std::size_t j = 0; j < n; ++j) {
        double pivot = A[j][j];
        for (std::size_t k = 0; k < j; ++k) pivot -= A[j][k] * A[j][k];
        A[j][j] = 1.0 / std::sqrt(std::max(pivot, 1e-9));
        for (std::size_t i = j + 1; i < n; ++i) {
            double sum = A[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
            A[i][j] = sum * A[j][j];
        }
    }
}

void solve(const Square& factor, std::size_t n, Column& x)
{
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) x[i] -= factor[i][k] * x[k];
        x[i] *= factor[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= factor[k][i] * x[k];
        x[i] *= factor[i][i];
    }
}

/// The covariances of the neighbours with each other, and with the point.
struct System {
    Square A;
    Column b;
};

System system_of(const Square& plain, const Square& relevant, std::size_t n, const Likeness& likeness)
{
    double distance = 0;
    for (std::size_t i = 0; i < n; ++i) distance += std::sqrt(plain[i][i]);
    distance = std::max(distance / static_cast<double>(n), 1e-30);
    const double unit = 1.0 / (distance * distance), noise = likeness.nugget + likeness.noise / distance;
    std::array<double, most*(most + 1) / 2> phi; // of i and the point, then of i and j < i
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) phi[count++] = plain[i][i] * unit;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) phi[count++] = (plain[i][i] + plain[j][j] - 2 * plain[i][j]) * unit;
    radial(phi.data(), count);
    const double sill = 5 * *std::max_element(phi.begin(), phi.begin() + static_cast<std::ptrdiff_t>(count));
    System system;
    count = n;
    for (std::size_t i = 0; i < n; ++i) {
        system.b[i] = sill - phi[i];
        for (std::size_t j = 0; j < i; ++j)
            system.A[i][j] = sill - phi[count++] + likeness.linear * unit * relevant[i][j];
        system.A[i][i] = sill + likeness.linear * unit * relevant[i][i] + noise;
    }
    return system;
}

} // namespace

std::array<double, most> Kriging::weights(std::size_t count, std::span<const double> g, const Likeness& likeness) const
{
    Square plain, relevant;
    products(e_.data(), g, plain, relevant);
    System system = system_of(plain, relevant, count, likeness);
    factorise(system.A, count);
    Column free = system.b, ones;
    ones.fill(1.0);
    solve(system.A, count, free);
    solve(system.A, count, ones);
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
