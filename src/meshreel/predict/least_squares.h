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
        Row gain{};
        double power = memory_;
        for (std::size_t j = 0; j < n; ++j) // P is symmetric: no sum waits for itself
            for (std::size_t i = 0; i < width; ++i) gain[i] += P_[j][i] * u[j];
        for (std::size_t i = 0; i < n; ++i) power += gain[i] * u[i];
        const double scale = 1.0 / power;
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            w_[i] += gain[i] * scale * error;
            for (std::size_t j = 0; j < width; ++j) P_[i][j] -= gain[i] * gain[j] * scale;
            largest = P_[i][i] > largest ? P_[i][i] : largest;
        }
        if (largest < most_doubt) forget();
    }

private:
    static constexpr double most_doubt = 100.0;           ///< where nothing new is seen, nothing old is forgotten
    static constexpr std::size_t width = (n + 3) / 4 * 4; ///< of rows, the rest 0: they fill registers

    using Row = std::array<double, width>;

    void forget()
    {
        const double inverse = 1.0 / memory_;
        for (Row& row : P_)
            for (std::size_t j = 0; j < width; ++j) row[j] *= inverse;
    }

    static constexpr std::array<Row, n> unit()
    {
        std::array<Row, n> matrix{};
        for (std::size_t i = 0; i < n; ++i) matrix[i][i] = 1.0;
        return matrix;
    }

    double memory_;
    Features w_{};
    std::array<Row, n> P_ = unit(); ///< inverse correlation of the features
};

} // namespace meshreel::predict
