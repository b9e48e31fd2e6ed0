/// The unit of posing and opening: the bare product of coefficients and basis in float32, on one core.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace meshreel::bench {

/// [V x K] [K x 3F], made of some numbers.
struct Product {
    Product(std::size_t V, std::size_t K, std::size_t F);
    /// Multiplies, with all that this machine's processor has.
    void run();

    std::size_t V, K, F;
    std::vector<float> coefficients, basis, positions;
};

} // namespace meshreel::bench
