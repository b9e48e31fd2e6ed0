/// The system (8.10), seen from one of its points, whence it is positive definite.
// SPDX-License-Identifier: MIT
#include "meshreel/predict/rbf.h"

#include <cmath>

#include "meshreel/predict/average.h"

namespace meshreel::predict {

double radial(double s)
{
    return s > 0 ? s / std::sqrt(std::sqrt(std::sqrt(s)))
                 : 0.0; // DEVIATES (8.7): r^1.75, the same everywhere; not r^1.8
}

void Rbf::start(std::size_t neighbours)
{
    n_ = neighbours;
    apart_.fill(0.0);
    away_.fill(0.0);
}

double Rbf::guess(std::span<const double> y)
{
    const std::size_t N = gather(y);
    return N == 1 ? average(y) : interpolate(N); // (8.4)
}

void Rbf::learn(std::span<const double> y, double value)
{
    for (std::size_t i = 0; i < n_; ++i) {
        for (std::size_t j = 0; j < i; ++j) apart_[i * most_neighbours + j] += (y[i] - y[j]) * (y[i] - y[j]);
        away_[i] += (value - y[i]) * (value - y[i]);
    }
}

/// Finds the places of the neighbours and how many there are.
/// DEVIATES (8.10): of neighbours within a step of each other the first stands for all, with the mean of their values;
/// the thesis drops the others, where equal.
std::size_t Rbf::gather(std::span<const double> y)
{
    std::array<double, most_neighbours> count;
    std::size_t N = 0;
    for (std::size_t i = 0; i < n_; ++i) {
        std::size_t place = 0;
        while (place < N && !(apart(i, kept_[place]) <= equal_)) ++place;
        if (place == N) {
            kept_[N] = i;
            mean_[N] = count[N] = 0.0;
            ++N;
        }
        mean_[place] += y[i];
        count[place] += 1.0;
    }
    for (std::size_t place = 0; place < N; ++place) mean_[place] /= count[place];
    return N;
}

/// (8.9) leaves N - 1 unknowns, one for each place but the first, o. With phi(x, y) = phi(|x - y|), (8.10) then reads
///
///     sum_j (phi(i, o) + phi(j, o) - phi(i, j)) w_j = phi(i, o) + phi(x, o) - phi(x, i)
///
/// and (8.7) f(x) = y_o + sum_j w_j (y_j - y_o).
double Rbf::interpolate(std::size_t N)
{
    std::array<double, most_neighbours> from_first, w;
    const double x_from_first = radial(away_[kept_[0]]);
    for (std::size_t i = 1; i < N; ++i) {
        from_first[i] = radial(apart(kept_[i], kept_[0]));
        w[i - 1] = from_first[i] + x_from_first - radial(away_[kept_[i]]);
    }
    system_.resize(N - 1);
    for (std::size_t i = 1; i < N; ++i) {
        for (std::size_t j = 1; j < i; ++j)
            system_(i - 1, j - 1) = from_first[i] + from_first[j] - radial(apart(kept_[i], kept_[j]));
        system_(i - 1, i - 1) = 2 * from_first[i];
    }
    system_.solve(std::span(w).first(N - 1)); // (8.8)-(8.10)
    double sum = mean_[0];
    for (std::size_t i = 1; i < N; ++i) sum += w[i - 1] * (mean_[i] - mean_[0]); // (8.7)
    return sum;
}

} // namespace meshreel::predict
