/// Sums, largest values and 8-bit levels of errors as they stream by.
// SPDX-License-Identifier: MIT
#include "cli/pictures/heat.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace meshreel::cli {

namespace {

constexpr double infinite_error = std::numeric_limits<double>::infinity();

/// An error without NaN.
double sound(double error)
{
    return std::isnan(error) ? infinite_error : std::max(error, 0.0);
}

} // namespace

std::string HeatOf::text() const
{
    if (kind == Kind::frame) return fmt::format("frame {}", frame);
    return kind == Kind::mean ? "mean over all frames" : "largest over all frames";
}

void Heat::add(std::size_t frame, std::span<const double> errors)
{
    const std::size_t V = errors.size();
    sum_.resize(V, 0.0);
    largest_.resize(V, 0.0);
    double top = 0.0, sum = 0.0;
    for (std::size_t v = 0; v < V; ++v) {
        const double error = sound(errors[v]);
        largest_[v] = std::max(largest_[v], error);
        sum_[v] += error;
        if (!std::isfinite(error)) continue;
        top = std::max(top, error);
        sum += error;
    }
    if (tops_.empty() || static_cast<float>(top) > *std::max_element(tops_.begin(), tops_.end())) {
        worst_ = frame;
        worst_errors_.assign(errors.begin(), errors.end());
    }
    tops_.push_back(static_cast<float>(top));
    means_.push_back(static_cast<float>(V > 0 ? sum / static_cast<double>(V) : 0.0));
    if (std::find(wishes_.frames.begin(), wishes_.frames.end(), frame) != wishes_.frames.end())
        exact_[frame].assign(errors.begin(), errors.end());
    if (!wishes_.every_frame) return;
    for (double error : errors) {
        const double share = top > 0.0 ? std::min(sound(error) / top, 1.0) : std::isfinite(sound(error)) ? 0.0 : 1.0;
        levels_.push_back(static_cast<std::uint8_t>(std::lround(255.0 * share)));
    }
}

double Heat::largest() const
{
    return tops_.empty() ? 0.0 : static_cast<double>(*std::max_element(tops_.begin(), tops_.end()));
}

std::span<const std::uint8_t> Heat::levels(std::size_t frame) const
{
    return std::span(levels_).subspan(frame * vertex_count(), vertex_count());
}

std::vector<double> Heat::values(const HeatOf& of) const
{
    std::vector<double> values;
    if (of.kind == HeatOf::Kind::largest) {
        values = largest_;
    } else if (of.kind == HeatOf::Kind::mean) {
        values = sum_;
        for (double& value : values) value /= static_cast<double>(std::max<std::size_t>(1, frame_count()));
    } else if (const auto exact = exact_.find(of.frame); exact != exact_.end()) {
        values = exact->second;
    } else if (of.frame == worst_) {
        values = worst_errors_;
    } else {
        for (std::uint8_t level : levels(of.frame))
            values.push_back(static_cast<double>(tops_[of.frame]) * level / 255.0);
    }
    for (double& value : values) value = sound(value);
    return values;
}

} // namespace meshreel::cli
