/// The numbers that a source can have made, counted in rising order: every float32, or those that came out of a text.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace meshreel::coding {

/// A strictly rising row of numbers ..., x(-1), x(0), x(1), ...: all float32 (x and -x at n and -1 - n), or
///
///     x(n) = float32(scale * float32(D(n)) + offset)
///
/// with D(n) the decimal numbers of at most `digits` significant digits and at most `decimals` digits after the point.
/// So a file made by %f, %g or integers is told from its float32 values, also after a change of unit. Both sides of a
/// codec count on it: + - * / on doubles only. No value makes it fail: what is beyond the ends becomes an end.
struct NumberLine {
    static constexpr std::uint8_t most_digits = 15, most_decimals = 22;

    bool decimal = false;
    double scale = 1.0; ///< not 0
    double offset = 0.0;
    std::uint8_t digits = 6;   ///< 1 .. most_digits
    std::uint8_t decimals = 6; ///< 0 .. most_decimals

    /// x(n), finite.
    float at(std::int64_t n) const;
    /// Where a number lies on the line: n at x(n), nearly, and rising evenly in between.
    double position(double x) const;
    /// x(n + 1) - x(n) where x lies, nearly; above 0.
    double step(double x) const;
    /// The n whose x(n) is closest to x, nearly.
    std::int64_t nearest(double x) const;
};

/// The place of x among all float32, -0 below 0; and back, ends for what is beyond them.
std::int64_t float_place(float x);
float float_at(std::int64_t place);

} // namespace meshreel::coding
