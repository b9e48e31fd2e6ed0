/// Counting along float32 and along decimals.
// SPDX-License-Identifier: MIT
#include "meshreel/coding/number_line.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace meshreel::coding {

namespace {

constexpr std::int64_t largest_place = 0x7f7fffff; // of the largest finite float32
constexpr double farthest = 0x1p52;                // places are counted so far in doubles

/// 10^k; beyond 22 the nearest product of doubles.
constexpr std::array<double, 80> powers_of_ten = [] {
    std::array<double, 80> powers{1.0};
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = powers[k - 1] * 10.0;
    return powers;
}();

/// The distance of two float32 where x lies: 2^(exponent - 23).
double float_step(double x)
{
    const auto exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023;
    const std::int64_t used = std::clamp<std::int64_t>(exponent, -126, 127) - 23;
    return std::bit_cast<double>(static_cast<std::uint64_t>(used + 1023) << 52);
}

float within_float(double x)
{
    constexpr double largest = 0x1.fffffep127;
    return x == x ? static_cast<float>(std::clamp(x, -largest, largest)) : 0.0f;
}

/// How many times the step has grown tenfold: numbers of `digits` digits, `fine` of them below the first growth.
struct Decade {
    int grown = 0;
    double unit = 1.0; ///< 10^grown
};

Decade decade_of(double fine, double limit)
{
    Decade decade;
    while (fine >= limit * decade.unit && decade.grown < 60) decade.unit = powers_of_ten[++decade.grown];
    return decade;
}

} // namespace

std::int64_t float_place(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return bits >> 31 != 0 ? -1 - static_cast<std::int64_t>(bits & 0x7fffffff) : static_cast<std::int64_t>(bits);
}

float float_at(std::int64_t place)
{
    const bool negative = place < 0;
    const std::int64_t magnitude = std::min(negative ? -1 - place : place, largest_place);
    return std::bit_cast<float>(static_cast<std::uint32_t>(magnitude) | (negative ? 0x80000000u : 0u));
}

float NumberLine::at(std::int64_t n) const
{
    if (!decimal) return float_at(n);
    const auto limit = static_cast<std::int64_t>(powers_of_ten[digits]);
    const std::int64_t size = std::min(n < 0 ? -std::max(n, -(std::int64_t{1} << 52)) : n, std::int64_t{1} << 52);
    const std::int64_t decade = limit - limit / 10; // numbers between two growths of the step
    const std::int64_t grown = size < limit ? 0 : std::min<std::int64_t>((size - limit) / decade + 1, 60);
    const std::int64_t digits_of = grown == 0 ? size : limit / 10 + (size - limit) - (grown - 1) * decade;
    const std::int64_t after_point = decimals - grown;
    const double D = after_point >= 0 ? static_cast<double>(digits_of) / powers_of_ten[after_point]
                                      : static_cast<double>(digits_of) * powers_of_ten[-after_point];
    const double text = static_cast<double>(within_float(n < 0 ? -D : D));
    return within_float(scale * text + offset);
}

double NumberLine::position(double x) const
{
    if (!decimal) {
        const float below = within_float(x);
        const double place = static_cast<double>(float_place(below)) + (x - static_cast<double>(below)) / float_step(x);
        return place == place ? std::clamp(place, -farthest, farthest) : 0.0;
    }
    const double D = (x - offset) / scale, fine = (D < 0 ? -D : D) * powers_of_ten[decimals];
    if (!(fine < 1e75)) return 0.0;
    const double limit = powers_of_ten[digits];
    const Decade decade = decade_of(fine, limit);
    double place = fine / decade.unit;
    if (decade.grown > 0) place += 0.9 * limit * decade.grown;
    place = std::min(place, farthest);
    return D < 0 ? -place : place;
}

double NumberLine::step(double x) const
{
    if (!decimal) return float_step(x);
    const double D = (x - offset) / scale, fine = (D < 0 ? -D : D) * powers_of_ten[decimals];
    if (!(fine < 1e75)) return scale < 0 ? -scale : scale;
    const double step = scale / powers_of_ten[decimals] * decade_of(fine, powers_of_ten[digits]).unit;
    return step < 0 ? -step : step;
}

std::int64_t NumberLine::nearest(double x) const
{
    const double place = position(x);
    return static_cast<std::int64_t>(place < 0 ? place - 0.5 : place + 0.5);
}

} // namespace meshreel::coding
