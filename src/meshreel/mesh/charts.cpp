/// Wedges by what is the same, charts by joining triangles across edges.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/charts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <tuple>

namespace meshreel {

namespace {

constexpr std::uint32_t no_value = 0xffffffff;

/// A number for every corner's value: the first corner that has it, as far as bytes tell.
std::vector<std::uint32_t> value_numbers(const Attribute& attribute, std::size_t corner_count)
{
    const std::size_t size = scalar_size(attribute.type) * attribute.components;
    const auto value = [&](std::uint32_t c) { return attribute.indices.empty() ? c : attribute.indices[c]; };
    const auto difference = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint8_t* values = attribute.values.data();
        return std::memcmp(values + value(a) * size, values + value(b) * size, size);
    };
    std::vector<std::uint32_t> corners;
    for (std::uint32_t c = 0; c < corner_count; ++c)
        if (value(c) != no_value) corners.push_back(c);
    std::ranges::sort(corners, [&](std::uint32_t a, std::uint32_t b) {
        const int found = difference(a, b);
        return found != 0 ? found < 0 : a < b;
    });
    std::vector<std::uint32_t> numbers(corner_count, no_value);
    for (std::size_t i = 0; i < corners.size(); ++i)
        numbers[corners[i]] =
            i > 0 && difference(corners[i], corners[i - 1]) == 0 ? numbers[corners[i - 1]] : corners[i];
    return numbers;
}

/// Makes wedges differ where the numbers do.
void refine(std::vector<std::uint32_t>& wedges, std::span<const std::uint32_t> numbers)
{
    std::vector<std::uint32_t> corners(wedges.size());
    std::iota(corners.begin(), corners.end(), 0u);
    const auto key = [&](std::uint32_t c) { return std::pair(wedges[c], numbers[c]); };
    std::ranges::sort(corners, {}, key);
    std::vector<std::uint32_t> refined(wedges.size());
    std::uint32_t wedge = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (i > 0 && key(corners[i]) != key(corners[i - 1])) ++wedge;
        refined[corners[i]] = wedge;
    }
    wedges = std::move(refined);
}

/// An edge from its lower to its higher vertex, as one triangle has it.
struct ChartSide {
    std::array<std::uint32_t, 4> vertices_and_wedges; ///< low, high, and the wedges there
    std::uint32_t triangle;
};

std::vector<ChartSide> sides_of(std::span<const Triangle> triangles, std::span<const std::uint32_t> wedges)
{
    std::vector<ChartSide> sides;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            std::size_t a = i, b = (i + 1) % 3;
            if (triangles[t][b] < triangles[t][a]) std::swap(a, b);
            sides.push_back({{triangles[t][a], triangles[t][b], wedges[3ul * t + a], wedges[3ul * t + b]}, t});
        }
    std::ranges::sort(sides, [](const ChartSide& a, const ChartSide& b) {
        return std::tie(a.vertices_and_wedges, a.triangle) < std::tie(b.vertices_and_wedges, b.triangle);
    });
    return sides;
}

} // namespace

std::vector<std::uint32_t> wedges_of(std::span<const Triangle> triangles, const Appearance& appearance)
{
    std::vector<std::uint32_t> wedges;
    for (const Triangle& t : triangles) wedges.insert(wedges.end(), t.begin(), t.end());
    for (const Attribute& attribute : appearance.attributes)
        if (attribute.domain == Domain::corner) refine(wedges, value_numbers(attribute, wedges.size()));
    return wedges;
}

std::vector<std::uint32_t> charts_of(std::span<const Triangle> triangles, std::span<const std::uint32_t> wedges)
{
    std::vector<std::uint32_t> chart(triangles.size());
    std::iota(chart.begin(), chart.end(), 0u);
    const auto root = [&](std::uint32_t t) {
        while (chart[t] != t) t = chart[t] = chart[chart[t]];
        return t;
    };
    const std::vector<ChartSide> sides = sides_of(triangles, wedges);
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].vertices_and_wedges != sides[i - 1].vertices_and_wedges) continue;
        const std::uint32_t a = root(sides[i].triangle), b = root(sides[i - 1].triangle);
        chart[std::max(a, b)] = std::min(a, b);
    }
    for (std::uint32_t t = 0; t < chart.size(); ++t) chart[t] = root(t);
    return chart;
}

} // namespace meshreel
