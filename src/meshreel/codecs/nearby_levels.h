/// How large the levels of a place's neighbours are: a context of its own levels.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "meshreel/base/views.h"
#include "meshreel/predict/kriging.h"

namespace meshreel::codecs {

/// The nearer a neighbour, the more its levels say: 1 / (1 + i), and their sums.
struct NearbyShares {
    static constexpr std::size_t most = predict::Kriging::most;

    std::array<double, most> shares{};
    std::array<double, most + 1> sums{};

    constexpr NearbyShares()
    {
        for (std::size_t i = 0; i < most; ++i) {
            shares[i] = 1.0 / static_cast<double>(1 + i);
            sums[i + 1] = sums[i] + shares[i];
        }
    }
};

/// Means of magnitudes L, columns from `first` on, over the neighbours' rows, the nearest first, at most Kriging::most;
/// 4 where there are none: nothing is known.
template <class Row>
void mean_of_nearby(std::span<const Row> rows, MatrixView<const std::uint8_t> L, std::size_t first,
                    std::span<double> nearby)
{
    static constexpr NearbyShares table;
    std::fill(nearby.begin(), nearby.end(), rows.empty() ? 4.0 : 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::uint8_t* __restrict sizes = L.row(rows[i]).data() + first;
        const double share = table.shares[i];
        for (std::size_t k = 0; k < nearby.size(); ++k) nearby[k] += share * sizes[k];
    }
    if (rows.empty()) return;
    for (double& mean : nearby) mean = mean / table.sums[rows.size()];
}

} // namespace meshreel::codecs
