/// Spacings show as peaks of a Fourier transform of where values are; what they were multiplied with follows from all of them.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/number_source.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include <unsupported/Eigen/FFT>

namespace meshreel::codecs {

namespace {

using coding::NumberLine;
using Values = std::vector<double>; // sorted, each once

constexpr std::size_t most_values = std::size_t{1} << 20, judges = 4096;

/// Fourier transforms of real values, of one size.
class Fourier {
public:
    explicit Fourier(std::size_t size) : size_(size) { fft_.SetFlag(Eigen::FFT<float>::HalfSpectrum); }

    std::size_t size() const { return size_; }

    /// Magnitudes of frequencies 0 .. size / 2.
    std::vector<float> magnitudes(const std::vector<float>& values)
    {
        std::vector<std::complex<float>> spectrum;
        fft_.fwd(spectrum, values);
        std::vector<float> magnitudes(spectrum.size());
        std::ranges::transform(spectrum, magnitudes.begin(), [](const auto& value) { return std::abs(value); });
        return magnitudes;
    }

private:
    std::size_t size_;
    Eigen::FFT<float> fft_;
};

/// Numbers offset + k q.
struct Spacing {
    double q = 0.0, offset = 0.0;
};

/// Least squares of values to offset + k q, from a guess that is right to a fraction of q; or to k q alone.
Spacing fitted(std::span<const double> values, Spacing guess, bool through_zero)
{
    for (int turn = 0; turn < 3; ++turn) {
        double n = 0, sum_k = 0, sum_u = 0, kk = 0, ku = 0;
        const double origin = through_zero ? 0.0 : guess.offset;
        for (const double u : values) {
            const double k = std::round((u - origin) / guess.q), off = u - origin - k * guess.q;
            if (std::abs(off) > 0.25 * guess.q) continue;
            ++n;
            sum_k += k;
            sum_u += u - origin;
            kk += k * k;
            ku += k * (u - origin);
        }
        const double spread = through_zero ? kk : kk - sum_k * sum_k / n;
        if (!(n > 8 && spread > 0)) break;
        guess.q = (through_zero ? ku : ku - sum_k * sum_u / n) / spread;
        if (!through_zero) guess.offset = origin + (sum_u - guess.q * sum_k) / n;
    }
    return guess;
}

/// The spacing of most values of a window; nothing where they have none.
std::optional<Spacing> spacing_of(std::span<const double> values, Fourier& fourier)
{
    if (values.size() < 64) return {};
    const double low = values.front(), width = values.back() - low;
    const double bin = width / static_cast<double>(fourier.size() / 2 - 1);
    std::vector<float> seen(fourier.size());
    for (const double u : values) seen[static_cast<std::size_t>((u - low) / bin)] = 1.0f;
    const double count = static_cast<double>(std::ranges::count(seen, 1.0f));
    const std::vector<float> strength = fourier.magnitudes(seen);
    const std::size_t slowest = 64, fastest = fourier.size() / 3;
    const double highest =
        *std::max_element(strength.begin() + slowest, strength.begin() + static_cast<std::ptrdiff_t>(fastest));
    if (highest < 0.4 * count || highest < 6 * std::sqrt(count)) return {};
    std::size_t peak = slowest;
    while (strength[peak] < 0.9 * highest) ++peak;
    while (strength[peak + 1] > strength[peak]) ++peak;
    const double left = strength[peak - 1], middle = strength[peak], right = strength[peak + 1];
    const double beside = 0.5 * (left - right) / (left - 2 * middle + right);
    Spacing spacing{bin * static_cast<double>(fourier.size()) / (static_cast<double>(peak) + beside), 0.0};
    std::complex<double> phase = 0;
    for (const double u : values) phase += std::polar(1.0, 2 * std::numbers::pi * (u - low) / spacing.q);
    spacing.offset = low + std::arg(phase) / (2 * std::numbers::pi) * spacing.q;
    return fitted(values, spacing, false);
}

double float_spacing(double x)
{
    return NumberLine{}.step(x);
}

/// Looks for the line of one coordinate.
class LineSearch {
public:
    LineSearch(MatrixView<const float> frames, std::size_t c, Fourier& fourier) : fourier_(fourier)
    {
        const std::size_t count = frames.values().size() / 3, stride = std::max<std::size_t>(count / most_values, 1);
        for (std::size_t i = 0; i < count; i += stride) values_.push_back(static_cast<double>(frames.data[3 * i + c]));
        sort(values_);
        for (const double x : values_) sizes_.push_back(std::abs(x));
        sort(sizes_);
        const std::size_t step = std::max<std::size_t>(values_.size() / judges, 1);
        for (std::size_t i = 0; i < values_.size(); i += step) judges_.push_back(values_[i]);
    }

    NumberLine found()
    {
        best_bits_ = 0.3; // not worth it below
        if (values_.size() < 64) return {};
        if (const auto spacing = spacing_of(values_, fourier_)) {
            judge_even(*spacing);
            judge_decimals(*spacing, sizes_);
        }
        for (const double quantile : {0.97, 0.85, 0.6, 0.3}) {
            if (best_bits_ > 3) break;
            const std::span<const double> window = around(quantile);
            const auto spacing = spacing_of(window, fourier_);
            if (spacing) judge_decimals(*spacing, window);
        }
        return best_;
    }

private:
    static void sort(Values& values)
    {
        std::ranges::sort(values);
        values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    /// Magnitudes within a few percent of a quantile.
    std::span<const double> around(double quantile) const
    {
        const auto middle = static_cast<std::size_t>(quantile * static_cast<double>(sizes_.size() - 1));
        for (const double reach : {1.015, 1.06}) {
            const auto first = std::ranges::lower_bound(sizes_, sizes_[middle] / reach);
            const auto last = std::ranges::upper_bound(sizes_, sizes_[middle] * reach);
            if (last - first >= 256 || reach > 1.05) return {first, last};
        }
        return {};
    }

    /// Even spacing from anywhere, as it comes from integers.
    void judge_even(const Spacing& spacing)
    {
        Spacing all = fitted(values_, spacing, false);
        all.offset -= all.q * std::round(all.offset / all.q);
        NumberLine line{true, all.q, all.offset, NumberLine::most_digits, 0};
        judge(line);
        line.scale = static_cast<float>(all.q);
        line.offset = static_cast<float>(all.offset);
        judge(line);
    }

    /// Decimals times a scale: the same number of them after the point, or of digits in all.
    void judge_decimals(const Spacing& spacing, std::span<const double> window)
    {
        const double power = std::pow(10.0, std::round(std::log10(spacing.q)));
        for (double q : {fitted(window, spacing, true).q, power}) {
            if (!(std::abs(q / spacing.q - 1) < 1e-3)) continue;
            const int digits = static_cast<int>(std::floor(std::log10(window[window.size() / 2] / q))) + 1;
            for (std::uint8_t decimals = 0; decimals < 10; ++decimals) {
                const double scale = q * std::pow(10.0, decimals);
                judge_refined({true, scale, 0.0, NumberLine::most_digits, decimals});
                const auto finest = static_cast<std::uint8_t>(decimals + 10);
                if (digits >= 1 && digits <= 9)
                    judge_refined({true, scale, 0.0, static_cast<std::uint8_t>(digits), finest});
            }
        }
    }

    void judge_refined(NumberLine line)
    {
        if (bits_saved(line) < best_bits_ - 2) return;
        judge(line);
        line.scale = best_scale(line);
        judge(line);
    }

    void judge(const NumberLine& line)
    {
        const double bits = bits_saved(line);
        if (bits <= best_bits_) return;
        best_bits_ = bits;
        best_ = line;
    }

    /// Bits a value that its line saves against float32: for its coarser steps, less those for values that are not on it.
    double bits_saved(const NumberLine& line) const
    {
        double saved = 0, missed = 0, correction = 0;
        for (const double x : judges_) {
            const std::int64_t off =
                coding::float_place(static_cast<float>(x)) - coding::float_place(line.at(line.nearest(x)));
            saved += std::log2(line.step(x) / float_spacing(x));
            if (off == 0) continue;
            ++missed;
            correction += 2 * std::log2(1 + std::abs(static_cast<double>(off)));
        }
        const double n = static_cast<double>(judges_.size()), p = missed / n;
        const double flags = p > 0 && p < 1 ? -p * std::log2(p) - (1 - p) * std::log2(1 - p) : 0;
        return (saved - correction) / n - flags;
    }

    /// The scale at which most values are what float32 rounds them to.
    double best_scale(const NumberLine& line) const
    {
        NumberLine text = line;
        text.scale = 1.0;
        std::vector<std::pair<double, int>> ends; // of the scales that are right for a value
        for (const double x : judges_) {
            const double D = std::abs(static_cast<double>(text.at(line.nearest(x)))), half = 0.5 * float_spacing(x);
            if (D == 0) continue;
            ends.emplace_back((std::abs(x) - half) / D, 1);
            ends.emplace_back((std::abs(x) + half) / D, -1);
        }
        std::ranges::sort(ends);
        int right = 0, most = 0;
        double low = line.scale, high = line.scale;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            right += ends[i].second;
            if (right <= most) continue;
            most = right;
            low = ends[i].first;
            high = ends[i + 1].first;
        }
        for (const double plain : {1.0, static_cast<double>(static_cast<float>(0.5 * (low + high)))})
            if (plain > low && plain < high) return plain;
        return 0.5 * (low + high);
    }

    Fourier& fourier_;
    Values values_, sizes_, judges_; ///< all, their magnitudes, and some of them
    NumberLine best_;
    double best_bits_ = 0.0;
};

} // namespace

std::array<NumberLine, 3> number_lines(MatrixView<const float> frames, Threads threads)
{
    const std::size_t count = frames.values().size() / 3; // few values tell little of fine spacings
    const std::size_t size = std::size_t{1} << (count < 1 << 11 ? 16 : count < 1 << 15 ? 18 : 20);
    std::array<NumberLine, 3> lines;
    parallel_for(3, threads, [&](std::size_t c) {
        Fourier fourier(size);
        lines[c] = LineSearch(frames, c, fourier).found();
    });
    return lines;
}

} // namespace meshreel::codecs
