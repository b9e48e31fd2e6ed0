/// Eigen's product, compiled for the machine at hand.
// SPDX-License-Identifier: MIT
#include "bench/product.h"

// The library has Eigen inside as well, compiled for any machine: the two must not be taken for each other.
#define Eigen EigenOfThisMachine
#include <Eigen/Dense>

namespace meshreel::bench {

namespace {

using Dense = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<float> some_numbers(std::size_t count)
{
    std::vector<float> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<float>(i % 1009) / 1009.0f - 0.5f;
    return numbers;
}

} // namespace

Product::Product(std::size_t vertices, std::size_t bases, std::size_t frames)
    : V(vertices), K(bases), F(frames), coefficients(some_numbers(V * K)), basis(some_numbers(K * 3 * F)),
      positions(V * 3 * F)
{
}

void Product::run()
{
    const auto size = [](std::size_t n) { return static_cast<Eigen::Index>(n); };
    const Eigen::Map<const Dense> C(coefficients.data(), size(V), size(K)), B(basis.data(), size(K), size(3 * F));
    Eigen::Map<Dense>(positions.data(), size(V), size(3 * F)).noalias() = C * B;
}

} // namespace meshreel::bench

#undef Eigen
