/// Prices of runs of frames, and cuts where they are lowest.
// SPDX-License-Identifier: MIT
#include "meshreel/segmenting.h"

#include <algorithm>
#include <cmath>

namespace meshreel {

namespace {

constexpr double worth_cutting = 0.95;       ///< of the price uncut: what is guessed must be clear
constexpr double bits_a_segment = 4000;      ///< its head, and what its contexts have to learn
constexpr std::size_t shortest_segment = 24; ///< frames
constexpr std::size_t places_looked_at = 16; ///< a round, from coarse to fine

/// Bits of a number that is `size` steps large, as predictors leave about half of what a number has.
double coded_bits(double size)
{
    return 0.5 * std::log2(1.0 + size);
}

struct Cut {
    std::size_t frame;
    double price;
};

/// The best place to cut frames first .. last - 1: among equally spaced ones, then nearer and nearer around the best.
Cut best_cut(std::size_t first, std::size_t last, const SegmentCosts& costs)
{
    std::size_t low = first + shortest_segment, high = last - shortest_segment;
    Cut best{low, HUGE_VAL};
    for (std::size_t apart = high - low; apart > 0;) {
        apart = apart > 1 ? std::max<std::size_t>(1, (high - low) / places_looked_at) : 0;
        for (std::size_t c = low; c <= high; c += std::max<std::size_t>(apart, 1)) {
            const double price = costs.of(first, c) + costs.of(c, last);
            if (price < best.price) best = {c, price};
        }
        if (apart <= 1) break;
        low = std::max(low, best.frame - std::min(best.frame, apart));
        high = std::min(high, best.frame + apart);
    }
    return best;
}

void cut_where_it_pays(FrameSpan span, const SegmentCosts& costs, std::vector<FrameSpan>& result)
{
    if (span.count >= 2 * shortest_segment) {
        const std::size_t last = span.first + span.count;
        const Cut cut = best_cut(span.first, last, costs);
        if (cut.price < worth_cutting * costs.of(span.first, last)) {
            cut_where_it_pays({span.first, cut.frame - span.first}, costs, result);
            cut_where_it_pays({cut.frame, last - cut.frame}, costs, result);
            return;
        }
    }
    result.push_back(span);
}

/// Cuts at the ends of equal parts may have turned out to be in the wrong place.
std::vector<FrameSpan> joined(const std::vector<FrameSpan>& spans, std::size_t longest, const SegmentCosts& costs)
{
    std::vector<FrameSpan> result;
    for (const FrameSpan& span : spans) {
        const bool fits = !result.empty() && result.back().count + span.count <= longest;
        const std::size_t last = span.first + span.count;
        if (fits && costs.of(result.back().first, last) <=
                        costs.of(result.back().first, span.first) + costs.of(span.first, last))
            result.back().count += span.count;
        else
            result.push_back(span);
    }
    return result;
}

} // namespace

std::vector<FrameSpan> equal_segments(std::size_t F, std::size_t longest)
{
    const std::size_t count = F / longest + (F % longest != 0);
    std::vector<FrameSpan> segments;
    for (std::size_t s = 0; s < count; ++s) segments.push_back({F * s / count, F * (s + 1) / count - F * s / count});
    return segments;
}

std::size_t longest_segment(std::uint32_t coded_vertices, bool exact)
{
    const double memory = exact ? 0.95e9 : 1.2e9,
                 fixed = exact ? 3400 : 2400; // bytes a vertex: coefficients, orders, walks
    constexpr double a_frame = 24;            // two sets of frames
    const double fitting = (memory / coded_vertices - fixed) / a_frame, most = coded_vertices > 3000 ? 1000 : 4000;
    return static_cast<std::size_t>(std::clamp(fitting, 32.0, most));
}

std::size_t longest_rich_segment(std::uint32_t coded_vertices)
{
    constexpr double memory = 1.2e9, fixed = 1100;
    constexpr double a_frame = 12 + 3 * 16; // frames, and coefficients asked for and decoded
    return static_cast<std::size_t>(std::max((memory / coded_vertices - fixed) / a_frame, 32.0));
}

std::vector<FrameSpan> divided(std::span<const FrameSpan> segments, std::size_t longest)
{
    std::vector<FrameSpan> parts;
    for (const FrameSpan& segment : segments)
        for (const FrameSpan& part : equal_segments(segment.count, longest))
            parts.push_back({segment.first + part.first, part.count});
    return parts;
}

SegmentSample::SegmentSample(Matrix<float> frames, std::uint32_t coded_vertices)
    : frames_(std::move(frames)), spectra_(frames_.view()), coded_vertices_(coded_vertices)
{
}

Result<SegmentSample> SegmentSample::take(FrameSource& source, std::span<const std::uint32_t> original_of)
{
    constexpr std::size_t most_trajectories = 64, least_trajectories = 8, most_points = 8 << 20;
    const std::size_t F = source.frame_count(), W = original_of.size(),
                      N = std::min(W, std::clamp(most_points / F, least_trajectories, most_trajectories));
    Matrix<float> frames(F, 3 * N);
    MESHREEL_CHECK(for_frame_runs(source, [&](std::size_t first, MatrixView<const float> run) -> Status {
        for (std::size_t f = 0; f < run.rows; ++f)
            for (std::size_t i = 0; i < N; ++i)
                std::copy_n(run.row(f).data() + 3ul * original_of[i * W / N], 3, frames.row(first + f).data() + 3 * i);
        return Ok{};
    }));
    return SegmentSample(std::move(frames), static_cast<std::uint32_t>(W));
}

Spectrum SegmentSample::spectrum(std::size_t first, std::size_t last) const
{
    Spectrum spectrum{last - first, 0.0, {}};
    const double each_stands_for = static_cast<double>(coded_vertices_) / static_cast<double>(frames_.cols / 3);
    for (const double energy : spectra_.energies(first, last)) {
        spectrum.energy += each_stands_for * energy;
        spectrum.singular_values.push_back(std::sqrt(each_stands_for * energy));
    }
    return spectrum;
}

double SegmentCosts::of(std::size_t first, std::size_t last) const
{
    const double W = sample_.coded_vertices(), n = 3.0 * static_cast<double>(last - first);
    // A coefficient of x steps is kept, at its bits and the error of rounding, or left out, at its error: to halve the
    // step takes a bit, so a bit is worth (ln 4 / 12) D^2 of error, and rounding D^2 / 12 is worth 1 / ln 4.
    const double rounding = 1.0 / std::log(4.0), left_out = 12.0 / std::log(4.0);
    double bits = bits_a_segment;
    for (const double value : sample_.spectrum(first, last).singular_values) {
        const double x = value / std::sqrt(W) / price_.step;
        const double in_basis = x * std::sqrt(W / n) / price_.basis_ratio; // a basis number's size, in its steps
        bits += std::min(W * left_out * x * x, W * (rounding + coded_bits(x)) + n * coded_bits(in_basis));
    }
    return bits;
}

std::vector<FrameSpan> paying_segments(std::size_t F, std::size_t longest, const SegmentCosts& costs)
{
    std::vector<FrameSpan> spans;
    for (const FrameSpan& span : equal_segments(F, longest)) cut_where_it_pays(span, costs, spans);
    return joined(spans, longest, costs);
}

} // namespace meshreel
