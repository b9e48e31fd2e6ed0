/// One vertex at a time: pose what is guessed, measure, step, and back into the basis.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/length_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "meshreel/base/wide.h"

namespace meshreel::codecs {

namespace {

constexpr std::size_t most_lengths = 12, least_lengths = 2; // neighbours that are measured
constexpr int guess_passes = 2, guess_steps = 4;
constexpr double length_trust = 8.0;    // w of the second least variance
constexpr double stiffest_length = 3.0; // times that at most
constexpr double guess_over_step = 1.8; // times the step that is sure to descend
constexpr std::size_t guess_lanes = 8, guess_share = 16;

/// Sums of many terms, the i-th going to place i mod 8: one register of AVX-512.
using GuessLanes = std::array<double, guess_lanes>;

double total(const GuessLanes& sums)
{
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

constexpr std::size_t rows_at_once = 4; // of the basis: each place is fetched once for all of them

/// place [3F] += sum of c[k] rows[k], one after the other.
MESHREEL_WIDEST void add_components(std::span<const double> c, const double* __restrict rows, std::span<double> place)
{
    double* __restrict x = place.data();
    const std::size_t n = place.size(), whole = c.size() - c.size() % rows_at_once;
    for (std::size_t k = 0; k < whole; k += rows_at_once, rows += rows_at_once * n)
        for (std::size_t i = 0; i < n; ++i)
            x[i] = (((x[i] + c[k] * rows[i]) + c[k + 1] * rows[n + i]) + c[k + 2] * rows[2 * n + i]) +
                   c[k + 3] * rows[3 * n + i];
    for (std::size_t k = whole; k < c.size(); ++k, rows += n)
        for (std::size_t i = 0; i < n; ++i) x[i] += c[k] * rows[i];
}

/// (x - p) . rows[k] for some rows, which follow each other.
template <std::size_t count>
inline __attribute__((always_inline)) std::array<double, count>
shifts_along(const double* __restrict rows, std::span<const double> x, const double* __restrict p)
{
    const std::size_t n = x.size(), whole = n - n % guess_lanes;
    std::array<GuessLanes, count> sums{};
    for (std::size_t i = 0; i < whole; i += guess_lanes)
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t l = 0; l < guess_lanes; ++l) sums[k][l] += (x[i + l] - p[i + l]) * rows[k * n + i + l];
    std::array<double, count> result;
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t i = whole; i < n; ++i) sums[k][i - whole] += (x[i] - p[i]) * rows[k * n + i];
        result[k] = total(sums[k]);
    }
    return result;
}

/// c[k] += (x - p) . rows[k]
MESHREEL_WIDEST void add_shifts(std::span<const double> x, const double* p, const double* rows, std::span<double> c)
{
    std::size_t k = 0;
    for (; k + rows_at_once <= c.size(); k += rows_at_once, rows += rows_at_once * x.size()) {
        const auto shifts = shifts_along<rows_at_once>(rows, x, p);
        for (std::size_t i = 0; i < rows_at_once; ++i) c[k + i] += shifts[i];
    }
    for (; k < c.size(); ++k, rows += x.size()) c[k] += shifts_along<1>(rows, x, p)[0];
}

/// Distances [F] of two trajectories [3F].
MESHREEL_WIDEST void measure_distances(const double* __restrict x, const double* __restrict y, std::span<double> found)
{
    const std::size_t F = found.size();
    double* __restrict d = found.data();
    for (std::size_t f = 0; f < F; ++f) {
        const double dx = x[f] - y[f], dy = x[F + f] - y[F + f], dz = x[2 * F + f] - y[2 * F + f];
        d[f] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
}

/// A neighbour's distance: what it should be in all frames, and how much.
struct Length {
    double mean = 0.0, weight = 0.0; ///< weight: the variance, until all neighbours have theirs
};

MESHREEL_WIDE Length length_of(std::span<const double> distances)
{
    const double* __restrict d = distances.data();
    const std::size_t whole = distances.size() - distances.size() % guess_lanes;
    const double base = d[0], F = static_cast<double>(distances.size());
    GuessLanes sums{}, squares{};
    for (std::size_t i = 0; i < whole; i += guess_lanes)
        for (std::size_t l = 0; l < guess_lanes; ++l) {
            const double more = d[i + l] - base;
            sums[l] += more;
            squares[l] += more * more;
        }
    for (std::size_t i = whole; i < distances.size(); ++i) {
        const double more = d[i] - base;
        sums[i - whole] += more;
        squares[i - whole] += more * more;
    }
    const double mean = total(sums) / F;
    return {base + mean, std::max(0.0, total(squares) / F - mean * mean)};
}

/// slopes [3F] += w (1 - L / d) (x - y); nothing where d is 0.
MESHREEL_WIDEST void add_pull(const double* __restrict x, const double* __restrict y, Length length,
                              std::span<double> slopes)
{
    const std::size_t F = slopes.size() / 3;
    double* __restrict g = slopes.data();
    for (std::size_t f = 0; f < F; ++f) {
        const double dx = x[f] - y[f], dy = x[F + f] - y[F + f], dz = x[2 * F + f] - y[2 * F + f];
        const double d = std::sqrt(dx * dx + dy * dy + dz * dz);
        const double pull = length.weight * (1.0 - length.mean / (d > 0 ? d : 1.0));
        g[f] += pull * dx;
        g[F + f] += pull * dy;
        g[2 * F + f] += pull * dz;
    }
}

/// x -= step ((x - p) + slopes), and slopes = 0.
MESHREEL_WIDE void step_guess(double step, const double* __restrict p, std::span<double> slopes, double* __restrict x)
{
    double* __restrict g = slopes.data();
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        x[i] -= step * ((x[i] - p[i]) + g[i]);
        g[i] = 0.0;
    }
}

} // namespace

/// A vertex on its way; c [K], the others [3F] or, distances, [F].
struct LengthGuess::Guess {
    std::vector<double> c, start, reached, x, slopes, distances;
    std::array<Length, most_lengths> lengths{};
    std::size_t count = 0; ///< of lengths
    double step = 0.0;

    Guess(std::size_t K, std::size_t F) : c(K), start(3 * F), reached(3 * F), x(3 * F), slopes(3 * F), distances(F) {}

    /// From variances to w_j, and the step for them.
    void weigh()
    {
        double least = std::numeric_limits<double>::infinity(), second = least;
        for (std::size_t j = 0; j < count; ++j) {
            const double variance = lengths[j].weight;
            second = std::min(second, std::max(least, variance));
            least = std::min(least, variance);
        }
        double all = 1.0;
        for (std::size_t j = 0; j < count; ++j) {
            double& weight = lengths[j].weight;
            weight = length_trust * (stiffest_length * weight <= second ? stiffest_length : second / weight);
            all += weight;
        }
        step = guess_over_step / all;
    }
};

LengthGuess::LengthGuess(const Basis& basis, std::size_t vertex_count, Threads threads)
    : basis_(basis), threads_(threads), places_(vertex_count, basis.mean.size())
{
}

void LengthGuess::pose(std::span<const double> c, std::span<double> place) const
{
    std::copy(basis_.mean.begin(), basis_.mean.end(), place.begin());
    add_components(c, basis_.rows.values.data(), place);
}

void LengthGuess::know(std::span<const std::uint32_t> vertices, MatrixView<const double> C)
{
    parallel_for(vertices.size(), threads_, [&](std::size_t i) { pose(C.row(vertices[i]), places_.row(vertices[i])); });
}

Matrix<double> LengthGuess::corrections(std::span<const std::uint32_t> vertices,
                                        std::span<const Interpolation::Weights> weights, MatrixView<const double> C,
                                        Batch batch) const
{
    Matrix<double> result(vertices.size(), batch.last - batch.first);
    parallel_for((vertices.size() + guess_share - 1) / guess_share, threads_, [&](std::size_t share) {
        Guess guess(C.cols, places_.cols / 3);
        const std::size_t begin = share * guess_share, end = std::min(vertices.size(), begin + guess_share);
        for (std::size_t i = begin; i < end; ++i) {
            guess.count = std::min(most_lengths, weights[i].count);
            if (guess.count < least_lengths) continue;
            std::copy_n(C.row(vertices[i]).begin(), batch.first, guess.c.begin());
            weights[i].apply(C, batch.first, std::span(guess.c).subspan(batch.first));
            correct(guess, weights[i], batch.first);
            add_shifts(guess.x, guess.start.data(), basis_.rows.row(batch.first).data(), result.row(i));
        }
    });
    return result;
}

/// From c to x; components below `first` are known.
void LengthGuess::correct(Guess& guess, const Interpolation::Weights& near, std::size_t first) const
{
    pose(guess.c, guess.start);
    for (std::size_t j = 0; j < guess.count; ++j) {
        measure_distances(guess.start.data(), places_.row(near.vertices[j]).data(), guess.distances);
        guess.lengths[j] = length_of(guess.distances);
    }
    guess.weigh();
    guess.x = guess.reached = guess.start;
    for (int pass = 0; pass < guess_passes; ++pass) {
        if (pass > 0) {
            add_shifts(guess.x, guess.reached.data(), basis_.rows.row(first).data(), std::span(guess.c).subspan(first));
            pose(guess.c, guess.reached);
            guess.x = guess.reached;
        }
        descend(guess, near);
    }
}

void LengthGuess::descend(Guess& guess, const Interpolation::Weights& near) const
{
    for (int step = 0; step < guess_steps; ++step) {
        for (std::size_t j = 0; j < guess.count; ++j)
            add_pull(guess.x.data(), places_.row(near.vertices[j]).data(), guess.lengths[j], guess.slopes);
        step_guess(guess.step, guess.start.data(), guess.slopes, guess.x.data());
    }
}

std::uint64_t LengthGuess::terms(std::uint64_t K)
{
    constexpr std::uint64_t pull = 4; // products and a root of each of three coordinates
    return (2 * guess_passes - 1) * K + guess_passes * guess_steps * most_lengths * pull;
}

std::uint64_t LengthGuess::bytes(std::uint64_t W, std::uint64_t F, std::uint64_t K)
{
    return 8 * W * (3 * F + K);
}

} // namespace meshreel::codecs
