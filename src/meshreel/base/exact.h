/// Elementary functions from + - * / and sqrt alone, so that every IEEE machine computes the same bits.
// SPDX-License-Identifier: MIT
#pragma once

namespace meshreel::exact {

/// sin x and cos x, x in radians, |x| < 1e6; absolute error below 1e-12.
double sin(double x);
double cos(double x);

/// The natural logarithm of a normal number x > 0; error below 1e-12.
double log(double x);

/// base^exponent for base > 0 and exponent in multiples of 2^-16, |exponent| < 1024; relative error below 1e-12.
/// Whole part by squaring, fraction by a chain of square roots.
double power(double base, double exponent);

/// The nearest integer, halves away from zero; |x| < 2^62.
long long round(double x);

/// The largest integer not above x; |x| < 2^62.
long long floor(double x);

} // namespace meshreel::exact
