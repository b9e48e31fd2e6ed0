/// The normal equations of (8.5), a row at a time.
// SPDX-License-Identifier: MIT
#include "meshreel/predict/lsp.h"

#include <algorithm>

#include "meshreel/predict/average.h"

namespace meshreel::predict {

void Lsp::start(std::size_t neighbours)
{
    n_ = neighbours;
    known_ = 0;
    gram_.fill(0.0);
    right_.fill(0.0);
    first_equal_.fill(0);
}

double Lsp::guess(std::span<const double> y)
{
    std::array<std::size_t, most_neighbours> kept;
    std::size_t N = 0;
    for (std::size_t i = 0; i < n_; ++i)
        if (first_equal_[i] == i) kept[N++] = i;
    if (known_ < N) return average(y); // (8.4)
    // DEVIATES (8.5): a ridge of a step's square draws the weights to 1 / N. Values are known to a step, so that rows
    // below it are noise, which plain least squares would fit; and no system is singular.
    std::array<double, most_neighbours> w;
    system_.resize(N);
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j <= i; ++j) system_(i, j) = gram_[kept[i] * most_neighbours + kept[j]];
        system_(i, i) += ridge_;
        w[i] = right_[kept[i]] + ridge_ / static_cast<double>(N);
    }
    system_.solve(std::span(w).first(N)); // (8.5)
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += w[i] * y[kept[i]]; // (8.6)
    return sum;
}

void Lsp::learn(std::span<const double> y, double value)
{
    for (std::size_t i = 0; i < n_; ++i) {
        for (std::size_t j = 0; j <= i; ++j) gram_[i * most_neighbours + j] += y[i] * y[j];
        right_[i] += y[i] * value;
    }
    ++known_;
    for (std::size_t i = n_; i-- > 0;) {
        std::size_t j = 0;
        while (j < i && (first_equal_[j] != first_equal_[i] || y[j] != y[i])) ++j; // what is no number equals nothing
        first_equal_[i] = j;
    }
}

} // namespace meshreel::predict
