/// Viridis between its control points, and round numbers.
// SPDX-License-Identifier: MIT
#include "cli/pictures/colour_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace meshreel::cli {

std::array<std::uint8_t, 3> viridis_bytes(double x)
{
    const double place = (x > 0.0 ? std::min(x, 1.0) : 0.0) * static_cast<double>(viridis_colours.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), viridis_colours.size() - 2);
    const double share = place - static_cast<double>(i);
    const unsigned long low = std::strtoul(viridis_colours[i] + 1, nullptr, 16);
    const unsigned long high = std::strtoul(viridis_colours[i + 1] + 1, nullptr, 16);
    std::array<std::uint8_t, 3> bytes{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto channel = [&](unsigned long hex) { return static_cast<double>(hex >> (16 - 8 * c) & 255u); };
        bytes[c] = static_cast<std::uint8_t>(std::lround((1.0 - share) * channel(low) + share * channel(high)));
    }
    return bytes;
}

Colour viridis(double x)
{
    const auto [red, green, blue] = viridis_bytes(x);
    return {linear_of(red), linear_of(green), linear_of(blue)};
}

Scale scale_of(double top)
{
    const double leading = top / std::pow(10.0, std::floor(std::log10(top) + 1e-9));
    for (double three : {1.5, 3.0, 6.0})
        if (std::abs(leading - three) < 1e-6) return {top, 3};
    for (double five : {1.0, 2.5, 5.0})
        if (std::abs(leading - five) < 1e-6) return {top, 5};
    return {top, 4};
}

Scale scale_up_to(double largest)
{
    if (!(largest > 1e-290) || !std::isfinite(largest)) return scale_of(1.0);
    const double decade = std::pow(10.0, std::floor(std::log10(largest)));
    for (double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (step * decade >= largest * (1.0 - 1e-9)) return scale_of(step * decade);
    return scale_of(10.0 * decade);
}

std::string short_number(double value)
{
    return fmt::format("{:.4g}", value);
}

} // namespace meshreel::cli
