/// Recursive least squares: a linear predictor that learns from every value it sees, and slowly forgets.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace meshreel::predict {

/// y = w . u with the w that fits the past best, errors n values ago counting memory^n.  + - * / only.
/// @source S. Haykin, Adaptive Filter Theory, the exponentially weighted RLS algorithm
template <std::size_t n>
class LeastSquares {
public:
    using Features = std::array<double, n>; ///< about 1 in size

    explicit LeastSquares(double memory = 0.995) : memory_(memory) {}

    double predict(const Features& u) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += w_[i] * u[i];
        return sum;
    }

    /// error: what y was less predict(u).
    void learn(const Features& u, double error)
    {
        Features gain{};
        double power = memory_;
        for (std::size_t j = 0; j < n; ++j) // P is symmetric: no sum waits for itself
            for (std::size_t i = 0; i < n; ++i) gain[i] += P_[j][i] * u[j];
        for (std::size_t i = 0; i < n; ++i) power += gain[i] * u[i];
        const double scale = 1.0 / power;
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            w_[i] += gain[i] * scale * error;
            for (std::size_t j = 0; j < n; ++j) P_[i][j] -= gain[i] * gain[j] * scale;
            largest = P_[i][i] > largest ? P_[i][i] : largest;
        }
        if (largest < most_doubt) forget();
    }

private:
    static constexpr double most_doubt = 100.0; ///< where nothing new is seen, nothing old is forgotten

    void forget()
    {
        for (Features& row : P_)
            for (double& value : row) value *= 1.0 / memory_;
    }

    static constexpr std::array<Features, n> unit()
    {
        std::array<Features, n> matrix{};
        for (std::size_t i = 0; i < n; ++i) matrix[i][i] = 1.0;
        return matrix;
    }

    double memory_;
    Features w_{};
    std::array<Features, n> P_ = unit(); ///< inverse correlation of the features
};

} // namespace meshreel::predict
