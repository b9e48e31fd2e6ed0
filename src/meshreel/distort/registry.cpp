/// The one table of distortions, and what all of them check.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "meshreel/base/text.h"
#include "meshreel/distort/compression.h"
#include "meshreel/distort/distortion.h"
#include "meshreel/distort/noise.h"
#include "meshreel/distort/simplification.h"
#include "meshreel/distort/smoothing.h"
#include "meshreel/distort/waves.h"

namespace meshreel::distort {

namespace {

constexpr std::array distortions{
    Distortion{.name = "noise-vertex-frame",
               .summary = "Gaussian noise, another in every vertex and frame; amount: its deviation",
               .source = "thesis 7.4, 1",
               .has_seed = true,
               .apply = noise_in_vertex_and_frame},
    Distortion{.name = "noise-vertex",
               .summary = "Gaussian noise, another in every vertex, for good; amount: its deviation",
               .source = "thesis 7.4, 2",
               .has_seed = true,
               .apply = noise_in_vertex},
    Distortion{.name = "noise-frame",
               .summary = "each frame shifted by Gaussian noise; amount: its deviation",
               .source = "thesis 7.4, 3",
               .has_seed = true,
               .apply = noise_in_frame},
    Distortion{.name = "sine-space",
               .summary = "a wave through the model, A sin(omega x); amount: A",
               .source = "thesis 7.4, 4",
               .has_omega = true,
               .apply = sine_in_space},
    Distortion{.name = "sine-time",
               .summary = "the whole model swings, A sin(omega f); amount: A",
               .source = "thesis 7.4, 5",
               .has_omega = true,
               .apply = sine_in_time},
    Distortion{.name = "quantise",
               .summary = "Coddyac with coarse quantisation; amount: the step of the coefficients",
               .source = "thesis 7.4, 6; 8.1",
               .apply = coarse_quantisation},
    Distortion{.name = "basis",
               .summary = "Coddyac with few eigentrajectories; amount: how many",
               .source = "thesis 7.4, 7; 8.1",
               .unit = Unit::count,
               .nothing = HUGE_VAL, // no number of them is exact
               .more_is_worse = false,
               .apply = few_bases},
    Distortion{.name = "smooth",
               .summary = "every vertex moves half way to the mean of its neighbours; amount: how often",
               .source = "Laplacian smoothing",
               .unit = Unit::count,
               .apply = laplacian_smoothing},
    Distortion{.name = "taubin",
               .summary = "smoothing that hardly shrinks; amount: how often",
               .source = "Taubin 1995",
               .unit = Unit::count,
               .apply = taubin_smoothing},
    Distortion{.name = "simplify",
               .summary = "fewer vertices, new triangles; amount: the share of vertices that stay",
               .source = "mesh/coarse_surface.h",
               .unit = Unit::share,
               .nothing = 1.0,
               .more_is_worse = false,
               .keeps_mesh = false,
               .apply = simplification},
};

Error refused(std::string message, std::string field)
{
    return {ErrorCode::usage, std::move(message), std::move(field)};
}

Status check_request(const Distortion& distortion, const Request& request)
{
    constexpr double most_steps = 1e6;
    const double amount = request.amount;
    if (!std::isfinite(amount) || amount < 0) return refused("the amount must be a finite number, 0 or more", "amount");
    if (distortion.unit == Unit::share && !(amount > 0 && amount <= 1))
        return refused("a share must be above 0 and at most 1", "amount");
    if (distortion.unit == Unit::count && (amount != std::floor(amount) || amount > most_steps))
        return refused("the amount must be a whole number, at most 1000000", "amount");
    if (request.omega && !distortion.has_omega) return refused(concat(distortion.name, " has no omega"), "omega");
    if (request.omega && !(std::isfinite(*request.omega) && *request.omega > 0))
        return refused("omega must be a finite number above 0", "omega");
    return Ok{};
}

} // namespace

std::span<const Distortion> all()
{
    return distortions;
}

const Distortion* find(std::string_view name)
{
    const auto found = std::find_if(distortions.begin(), distortions.end(),
                                    [&](const Distortion& distortion) { return distortion.name == name; });
    return found == distortions.end() ? nullptr : &*found;
}

Result<Animation> distort(const Distortion& distortion, const Animation& animation, const Request& request)
{
    MESHREEL_CHECK(check_request(distortion, request));
    if (request.amount == distortion.nothing || animation.vertex_count == 0) return animation;
    MESHREEL_TRY(Animation result, distortion.apply(animation, request));
    const auto is_finite = [](float x) { return std::isfinite(x); };
    if (!std::all_of(result.positions.begin(), result.positions.end(), is_finite))
        return refused("the amount is so large that a position leaves float32", "amount");
    return result;
}

} // namespace meshreel::distort
