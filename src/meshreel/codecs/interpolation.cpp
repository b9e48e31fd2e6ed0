/// Neighbours by distance in all known components, weights by kriging.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/interpolation.h"

#include <algorithm>
#include <cmath>

namespace meshreel::codecs {

namespace {

struct Near {
    double square;
    std::uint32_t vertex;
    bool operator<(const Near& other) const
    {
        return square != other.square ? square < other.square : vertex < other.vertex;
    }
};

/// Squared distance over components 0 .. known-1, in four sums side by side.
double squared_distance_of(std::span<const double> a, std::span<const double> b, std::size_t known)
{
    std::array<double, 4> sums{};
    std::size_t k = 0;
    for (; k + 4 <= known; k += 4)
        for (std::size_t l = 0; l < 4; ++l) {
            const double difference = a[k + l] - b[k + l];
            sums[l] += difference * difference;
        }
    for (; k < known; ++k) sums[k % 4] += (a[k] - b[k]) * (a[k] - b[k]);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

} // namespace

Interpolation::Interpolation(MatrixView<const double> first, std::vector<double> relevance, InterpolationLaw law,
                             Threads threads)
    : order_(coarse_to_fine(first, candidates, threads)), relevance_(std::move(relevance)), law_(law), threads_(threads)
{
}

std::vector<Interpolation::Weights> Interpolation::weights(std::span<const std::uint32_t> vertices,
                                                           MatrixView<const double> C, std::size_t known) const
{
    std::vector<Weights> result(vertices.size());
    constexpr std::size_t block = 64;
    const std::size_t blocks = (vertices.size() + block - 1) / block;
    parallel_for(blocks, blocks < 4 ? Threads{1} : threads_, [&](std::size_t task) {
        predict::Kriging kriging(known);
        for (std::size_t i = task * block; i < std::min(vertices.size(), (task + 1) * block); ++i)
            result[i] = of_vertex(vertices[i], C, kriging, known);
    });
    return result;
}

Interpolation::Weights Interpolation::of_vertex(std::uint32_t v, MatrixView<const double> C, predict::Kriging& kriging,
                                                std::size_t known) const
{
    std::array<Near, candidates> near;
    std::size_t found = 0;
    for (; found < candidates && order_.nearest(v, found) != CoarseToFine::nobody; ++found) {
        const std::uint32_t u = order_.nearest(v, found);
        near[found] = {squared_distance_of(C.row(u), C.row(v), known), u};
    }
    Weights result;
    result.count = std::min(found, most);
    if (result.count == 0) return result;
    std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(found));
    const std::span<const double> own = C.row(v);
    for (std::size_t i = 0; i < result.count; ++i) {
        const std::uint32_t u = result.vertices[i] = near[i].vertex;
        const std::span<const double> its = C.row(u);
        for (std::size_t k = 0; k < known; ++k) kriging.differences(k)[i] = relevance_[k] * (its[k] - own[k]);
    }
    constexpr double nugget = 0.01, noise = 6.0;
    result.values = kriging.weights(result.count, known, {law_.linear, law_.squared_bend, nugget, noise * law_.step});
    return result;
}

void Interpolation::Weights::apply(MatrixView<const double> C, std::size_t first, std::span<double> guess) const
{
    std::fill(guess.begin(), guess.end(), 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const double* __restrict row = C.row(vertices[i]).data() + first;
        const double weight = values[i];
        for (std::size_t k = 0; k < guess.size(); ++k) guess[k] += weight * row[k];
    }
}

std::vector<double> relevance_of(std::span<const double> energies)
{
    std::vector<double> relevance(energies.size(), 1.0);
    for (std::size_t k = 3; k < energies.size(); ++k)
        relevance[k] = energies[k] > 0 ? std::sqrt(std::sqrt(std::sqrt(energies[2] / energies[k]))) : 0.0;
    return relevance;
}

} // namespace meshreel::codecs
