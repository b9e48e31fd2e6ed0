/// Small symmetric positive systems, solved the same way on every machine.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace meshreel::predict {

constexpr std::size_t most_neighbours = 24; ///< that a progressive predictor takes

/// A x = b for a symmetric positive semidefinite A of up to most_neighbours rows, by L D L^T without pivoting, from
/// + - * / in a fixed order.
class SmallSolve {
public:
    void resize(std::size_t n) { n_ = n; }
    std::size_t size() const { return n_; }
    /// The lower triangle, j <= i.
    double& operator()(std::size_t i, std::size_t j) { return A_[i * most_neighbours + j]; }

    /// Overwrites b [n] by the solution, and A by its factors. Where a row depends on those before it, up to rounding,
    /// its unknown is 0.
    void solve(std::span<double> b)
    {
        factor();
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t k = 0; k < i; ++k) b[i] -= at(i, k) * b[k];
        for (std::size_t i = 0; i < n_; ++i) b[i] = dependent_[i] ? 0.0 : b[i] / at(i, i);
        for (std::size_t i = n_; i-- > 0;) {
            if (dependent_[i]) continue;
            for (std::size_t k = i + 1; k < n_; ++k) b[i] -= at(k, i) * b[k];
        }
    }

private:
    static constexpr double least_pivot = 1e-12; ///< of the diagonal that it is left from

    double at(std::size_t i, std::size_t j) const { return A_[i * most_neighbours + j]; }

    /// L below the diagonal, D on it.
    void factor()
    {
        std::array<double, most_neighbours> scaled; // row i of L D
        for (std::size_t i = 0; i < n_; ++i) {
            double* row = &A_[i * most_neighbours];
            const double whole = row[i];
            for (std::size_t j = 0; j < i; ++j) {
                double sum = row[j];
                for (std::size_t k = 0; k < j; ++k) sum -= scaled[k] * at(j, k);
                scaled[j] = sum;
                row[j] = dependent_[j] ? 0.0 : sum / at(j, j);
            }
            for (std::size_t k = 0; k < i; ++k) row[i] -= scaled[k] * row[k];
            dependent_[i] = !(row[i] > least_pivot * whole);
        }
    }

    std::size_t n_ = 0;
    std::array<double, most_neighbours * most_neighbours> A_;
    std::array<bool, most_neighbours> dependent_;
};

} // namespace meshreel::predict
