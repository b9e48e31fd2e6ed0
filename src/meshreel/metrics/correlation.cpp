/// Sums of scaled values, ranks with ties, pairs counted while they are sorted; intervals by Fisher's transform.
// SPDX-License-Identifier: MIT
#include "meshreel/metrics/correlation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace meshreel::metrics {

namespace {

constexpr double normal_quantile = 1.959963984540054; // of 97.5 %: 2.5 % on either side
constexpr std::string_view interval_too_short = "too few pairs for an interval";

bool is_constant(std::span<const double> values)
{
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

/// Why there is no coefficient; empty: there is one.
std::string_view no_coefficient(std::span<const double> x, std::span<const double> y)
{
    if (x.size() < 3) return "fewer than 3 pairs";
    if (is_constant(x)) return "the measure is constant";
    return is_constant(y) ? "the score is constant" : "";
}

Correlation lacking(std::string_view why)
{
    return {{}, {}, why};
}

/// The interval of z = atanh r, brought back. variance: of z, infinite where it is unknown.
Correlation with_interval(double r, double variance)
{
    r = std::clamp(r, -1.0, 1.0); // rounding may overshoot
    if (!(variance > 0) || !std::isfinite(variance)) return {r, {}, interval_too_short};
    const double z = std::atanh(r), width = normal_quantile * std::sqrt(variance);
    return {r, Interval{std::tanh(z - width), std::tanh(z + width)}, {}};
}

/// Values less their mean, the largest of them 1: no square overflows or vanishes.
std::vector<double> centred(std::span<const double> values)
{
    const auto scaled = [](std::vector<double> all) {
        double largest = 0.0;
        for (const double value : all) largest = std::max(largest, std::abs(value));
        for (double& value : all) value = largest > 0 ? value / largest : 0.0;
        return all;
    };
    std::vector<double> all = scaled({values.begin(), values.end()});
    const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
    for (double& value : all) value -= mean;
    return scaled(std::move(all));
}

double pearson_of(std::span<const double> x, std::span<const double> y)
{
    const std::vector<double> a = centred(x), b = centred(y);
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    return ab / std::sqrt(aa * bb); // (7.16)
}

/// Ranks from 1; equal values share the mean of theirs.
std::vector<double> ranks(std::span<const double> values)
{
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> result(values.size());
    for (std::size_t i = 0; i < order.size();) {
        std::size_t end = i;
        while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
        for (std::size_t j = i; j < end; ++j) result[order[j]] = 0.5 * static_cast<double>(i + 1 + end);
        i = end;
    }
    return result;
}

using Pairs = std::vector<std::pair<double, double>>;

/// Pairs of equal neighbours in a sorted list: k equal ones make k (k - 1) / 2.
template <class Equal>
double ties(const Pairs& sorted, const Equal& equal)
{
    double count = 0.0, run = 0.0; // run: of equal ones before this
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        run = equal(sorted[i - 1], sorted[i]) ? run + 1 : 0.0;
        count += run;
    }
    return count;
}

/// Sorts [begin, end) by the second value, and counts the pairs that were in the wrong order.
double sort_and_count(Pairs& pairs, std::size_t begin, std::size_t end)
{
    if (end - begin < 2) return 0.0;
    const std::size_t middle = begin + (end - begin) / 2;
    double swaps = sort_and_count(pairs, begin, middle) + sort_and_count(pairs, middle, end);
    Pairs merged;
    std::size_t low = begin, high = middle;
    while (low < middle || high < end) {
        const bool from_low = high == end || (low < middle && pairs[low].second <= pairs[high].second);
        if (!from_low) swaps += static_cast<double>(middle - low);
        merged.push_back(pairs[from_low ? low++ : high++]);
    }
    std::copy(merged.begin(), merged.end(), pairs.begin() + static_cast<std::ptrdiff_t>(begin));
    return swaps;
}

double kendall_of(std::span<const double> x, std::span<const double> y)
{
    Pairs pairs;
    for (std::size_t i = 0; i < x.size(); ++i) pairs.emplace_back(x[i], y[i]);
    std::sort(pairs.begin(), pairs.end());
    const double n = static_cast<double>(pairs.size()), all = 0.5 * n * (n - 1);
    const double tied_x = ties(pairs, [](const auto& a, const auto& b) { return a.first == b.first; });
    const double tied_both = ties(pairs, [](const auto& a, const auto& b) { return a == b; });
    const double discordant = sort_and_count(pairs, 0, pairs.size());
    const double tied_y = ties(pairs, [](const auto& a, const auto& b) { return a.second == b.second; });
    const double difference = all - tied_x - tied_y + tied_both - 2 * discordant; // concordant less discordant
    return difference / std::sqrt((all - tied_x) * (all - tied_y));
}

} // namespace

Correlation pearson(std::span<const double> x, std::span<const double> y)
{
    const std::string_view why = no_coefficient(x, y);
    if (!why.empty()) return lacking(why);
    return with_interval(pearson_of(x, y), 1.0 / (static_cast<double>(x.size()) - 3.0));
}

Correlation spearman(std::span<const double> x, std::span<const double> y)
{
    const std::string_view why = no_coefficient(x, y);
    if (!why.empty()) return lacking(why);
    const double r = pearson_of(ranks(x), ranks(y));
    return with_interval(r, (1.0 + 0.5 * r * r) / (static_cast<double>(x.size()) - 3.0));
}

Correlation kendall(std::span<const double> x, std::span<const double> y)
{
    const std::string_view why = no_coefficient(x, y);
    if (!why.empty()) return lacking(why);
    return with_interval(kendall_of(x, y), 0.437 / (static_cast<double>(x.size()) - 4.0));
}

std::span<const Coefficient> coefficients()
{
    static constexpr std::array table{
        Coefficient{"pearson", "Pearson", "thesis (7.15), (7.16)", pearson},
        Coefficient{"spearman", "Spearman", "Pearson's of the ranks", spearman},
        Coefficient{"kendall", "Kendall", "tau-b", kendall},
    };
    return table;
}

} // namespace meshreel::metrics
