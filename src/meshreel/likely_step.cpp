/// Bisection on the error that a step should make.
// SPDX-License-Identifier: MIT
#include "meshreel/likely_step.h"

#include <algorithm>
#include <cmath>

namespace meshreel {

namespace {

/// The squared error at a step: of coefficients and basis, less than D^2 / 12 a value as most levels are 0; and what the
/// components left out hold, of those prepared.
double likely_error(const MotionFigures& motion, const codecs::Settings& settings, double step)
{
    const double W = motion.coded_vertices, basis = settings.basis_ratio * settings.basis_ratio;
    double error = 0;
    for (const Spectrum& spectrum : motion.spectra)
        for (double value : spectrum.singular_values)
            error += value < settings.truncation * step * std::sqrt(W)
                         ? value * value
                         : (W + 3 * static_cast<double>(spectrum.frame_count) * basis) * step * step / 20;
    return error;
}

double points_of(const MotionFigures& motion)
{
    std::size_t frames = 0;
    for (const Spectrum& spectrum : motion.spectra) frames += spectrum.frame_count;
    return static_cast<double>(frames) * motion.coded_vertices;
}

/// The root mean squared distance that keeps all limits, or nearly.
double likely_rms(const MotionFigures& motion, const Measures& allowed)
{
    constexpr double kg_of_sizes = 0.3, peak = 5.0, smoothness = 5.0; // guesses
    const double rms_of_kg = norm_of(motion.spectra) / std::sqrt(points_of(motion)) / 100;
    double rms = std::isfinite(allowed.bytes) ? kg_of_sizes * rms_of_kg : no_limit;
    if (std::isfinite(allowed.kg)) rms = std::min(rms, allowed.kg * rms_of_kg);
    if (std::isfinite(allowed.sted)) rms = std::min(rms, smoothness * allowed.sted * motion.mean_edge);
    return std::min({rms, allowed.rms, allowed.max_error / peak});
}

} // namespace

double norm_of(std::span<const Spectrum> spectra)
{
    double energy = 0;
    for (const Spectrum& spectrum : spectra) energy += spectrum.energy;
    return std::sqrt(energy);
}

double likely_step(const MotionFigures& motion, const Measures& allowed, const codecs::Settings& settings)
{
    const double rms = likely_rms(motion, allowed);
    if (!(rms > 0)) return motion.diagonal * 1e-4;
    const double squared = rms * rms * points_of(motion);
    double fine = std::log(1e-9 * motion.diagonal), coarse = std::log(motion.diagonal);
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (fine + coarse);
        (likely_error(motion, settings, std::exp(middle)) < squared ? fine : coarse) = middle;
    }
    return std::exp(fine);
}

} // namespace meshreel
