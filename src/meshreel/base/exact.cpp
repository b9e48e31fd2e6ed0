/// Elementary functions that are part of the format: no libm but sqrt, which IEEE 754 rounds correctly.
// SPDX-License-Identifier: MIT
#include "meshreel/base/exact.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace meshreel::exact {

namespace {

constexpr double half_pi_high = 0x1.921fb544p+0; // the leading 33 bits of pi/2, so that n * half_pi_high is exact
constexpr double half_pi_low = 0x1.0b4611a626331p-34;

/// Taylor series on [-pi/4, pi/4]; the first term left out is below 1e-15.
double sin_core(double x)
{
    const double s = x * x;
    double sum = -1.0 / 1307674368000.0;
    for (double c : {1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0})
        sum = sum * s + c;
    return x + x * s * sum;
}

double cos_core(double x)
{
    const double s = x * x;
    double sum = 1.0 / 20922789888000.0;
    for (double c :
         {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5})
        sum = sum * s + c;
    return 1.0 + s * sum;
}

/// sin(x + quarter_turns * pi/2).
double turned(double x, long long quarter_turns)
{
    const long long n = round(x / (half_pi_high + half_pi_low));
    const double rest = (x - static_cast<double>(n) * half_pi_high) - static_cast<double>(n) * half_pi_low;
    const auto quadrant = static_cast<std::uint64_t>(n + quarter_turns) & 3u;
    const double value = (quadrant & 1u) ? cos_core(rest) : sin_core(rest);
    return (quadrant & 2u) ? -value : value;
}

} // namespace

long long floor(double x)
{
    const auto whole = static_cast<long long>(x);
    return static_cast<double>(whole) > x ? whole - 1 : whole;
}

long long round(double x)
{
    return x < 0 ? -floor(-x + 0.5) : floor(x + 0.5);
}

double sin(double x)
{
    return turned(x, 0);
}
double cos(double x)
{
    return turned(x, 1);
}

double log(double x)
{
    constexpr double log_2_high = 0x1.62e42fefap-1, log_2_low = 0x1.cf79abc9e3b39p-40; // so that n * high is exact
    constexpr std::uint64_t fraction = (1ull << 52) - 1, one = 1023ull << 52;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    auto n = static_cast<double>(static_cast<int>(bits >> 52) - 1023);
    auto m = std::bit_cast<double>((bits & fraction) | one); // x = m 2^n
    if (m > 4.0 / 3.0) {
        m *= 0.5;
        n += 1.0;
    }
    const double t = (m - 1.0) / (m + 1.0), s = t * t; // |t| <= 1/5; log m = 2 (t + t^3 / 3 + t^5 / 5 + ...)
    double sum = 0.0;
    for (int k = 19; k >= 1; k -= 2) sum = sum * s + 2.0 / k;
    return n * log_2_high + (n * log_2_low + t * sum);
}

double power(double base, double exponent)
{
    if (exponent < 0) return 1.0 / power(base, -exponent);
    constexpr int fraction_bits = 16;
    const auto fixed = static_cast<std::uint64_t>(round(exponent * (1 << fraction_bits)));
    double result = 1.0;
    double square = base;
    for (std::uint64_t whole = fixed >> fraction_bits; whole != 0; whole >>= 1) {
        if (whole & 1u) result *= square;
        square *= square;
    }
    double root = base;
    for (int bit = fraction_bits - 1; bit >= 0; --bit) {
        root = std::sqrt(root);
        if ((fixed >> bit) & 1u) result *= root;
    }
    return result;
}

} // namespace meshreel::exact
