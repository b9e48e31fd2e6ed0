/// Neighbours by distance in all known components, weights by kriging.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/interpolation.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/prefetch.h"

namespace meshreel::codecs {

namespace {

/// The nearest by the first components, from which the best by all known ones are chosen: 24 for 16, 12 for 10.
std::size_t candidates_of(const InterpolationLaw& law)
{
    return std::max<std::size_t>(law.neighbours, 2 * law.neighbours - std::min(8u, law.neighbours));
}

/// Squared distance in four sums side by side.
double squared_distance_of(std::span<const double> a, std::span<const double> b)
{
    std::array<double, 4> sums{};
    std::size_t k = 0;
    for (; k + 4 <= a.size(); k += 4)
        for (std::size_t l = 0; l < 4; ++l) {
            const double difference = a[k + l] - b[k + l];
            sums[l] += difference * difference;
        }
    for (; k < a.size(); ++k) sums[k % 4] += (a[k] - b[k]) * (a[k] - b[k]);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

} // namespace

Interpolation::Interpolation(MatrixView<const double> first, std::vector<double> relevance, InterpolationLaw law,
                             Threads threads)
    : order_(coarse_to_fine(first, candidates_of(law), threads)), relevance_(std::move(relevance)), law_(law),
      threads_(threads)
{
}

Interpolation::Level Interpolation::level(std::span<const std::uint32_t> vertices) const
{
    Level level{vertices, 0, 0, {}};
    if (vertices.empty()) return level;
    const std::span<const std::uint32_t> some = order_.nearest.row(vertices.front()); // all have as many
    level.candidates =
        static_cast<std::size_t>(std::find(some.begin(), some.end(), CoarseToFine::nobody) - some.begin());
    for (const std::uint32_t v : vertices)
        for (std::size_t i = 0; i < level.candidates; ++i) level.near.push_back({0.0, order_.nearest(v, i)});
    return level;
}

std::vector<Interpolation::Weights> Interpolation::weights(Level& level, MatrixView<const double> C,
                                                           std::size_t known) const
{
    std::vector<Weights> result(level.vertices.size());
    if (level.candidates == 0) return result;
    constexpr std::size_t block = 64;
    const std::size_t blocks = (result.size() + block - 1) / block;
    parallel_for(blocks, blocks < 4 ? Threads{1} : threads_, [&](std::size_t task) {
        predict::Kriging kriging(known);
        for (std::size_t i = task * block; i < std::min(result.size(), (task + 1) * block); i += kriging.lanes) {
            const std::size_t count = std::min(kriging.lanes, result.size() - i);
            weigh({level, C, known}, i, kriging, std::span(result).subspan(i, count));
        }
    });
    level.known = known;
    return result;
}

void Interpolation::weigh(const Task& task, std::size_t first, predict::Kriging& kriging,
                          std::span<Weights> result) const
{
    const auto& [level, C, known] = task;
    const std::size_t n = std::min<std::size_t>(level.candidates, law_.neighbours);
    for (std::size_t lane = 0; lane < result.size(); ++lane) {
        if (first + lane + 1 < level.vertices.size()) fetch(first + lane + 1, task);
        const std::span<Near> near = level.of(first + lane);
        const std::span<const double> own = C.row(level.vertices[first + lane]);
        renew(near, own, task);
        for (std::size_t i = 0; i < n; ++i) {
            result[lane].vertices[i] = near[i].vertex;
            const double* __restrict its = C.row(near[i].vertex).data();
            for (std::size_t k = 0; k < known; ++k) kriging.differences(k)[i] = relevance_[k] * (its[k] - own[k]);
        }
        kriging.set(lane, n, known);
    }
    constexpr double nugget = 0.01, noise = 2.0;
    const auto values = kriging.weights(n, {law_.linear, law_.squared_bend, nugget, noise * law_.step});
    for (std::size_t lane = 0; lane < result.size(); ++lane) {
        result[lane].count = n;
        for (std::size_t i = 0; i < n; ++i) result[lane].values[i] = values[i][lane];
    }
}

void Interpolation::fetch(std::size_t i, const Task& task) const
{
    std::size_t place = 0;
    for (const Near& one : task.level.of(i)) {
        const std::size_t begin = place++ < law_.neighbours ? 0 : task.level.known; // farther ones are only measured
        prefetch(task.C.row(one.vertex).subspan(begin, task.known - begin));
    }
}

void Interpolation::renew(std::span<Near> near, std::span<const double> own, const Task& task)
{
    const std::size_t old = task.level.known, fresh = task.known - old;
    for (Near& one : near)
        one.square += squared_distance_of(task.C.row(one.vertex).subspan(old, fresh), own.subspan(old, fresh));
    for (std::size_t i = 1; i < near.size(); ++i) { // by insertion: but for the first time, little is out of order
        const Near one = near[i];
        std::size_t place = i;
        for (; place > 0 && one < near[place - 1]; --place) near[place] = near[place - 1];
        near[place] = one;
    }
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
