/// What settings mean for a PCA: how many components, which step.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "meshreel/codecs/settings.h"

namespace meshreel::codecs {

/// K: as asked for, or the components with s_k / sqrt(W) >= truncation * D. singular_values: s_k, falling.
inline std::size_t bases_of(const Settings& settings, std::span<const double> singular_values, double W)
{
    if (settings.bases) return std::min<std::size_t>(*settings.bases, singular_values.size());
    const double least = settings.truncation * settings.step * std::sqrt(W);
    return static_cast<std::size_t>(
        std::count_if(singular_values.begin(), singular_values.end(), [&](double s) { return s >= least; }));
}

/// D; where none is asked for, the one to which the last basis vector just matters.
inline double step_of(const Settings& settings, std::span<const double> singular_values, double W)
{
    if (settings.step > 0) return settings.step;
    const std::size_t K = bases_of(settings, singular_values, W);
    return K == 0 ? 1.0 : singular_values[K - 1] / (settings.truncation * std::sqrt(W));
}

} // namespace meshreel::codecs
