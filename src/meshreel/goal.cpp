/// Targets into limits.
// SPDX-License-Identifier: MIT
#include "meshreel/goal.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "meshreel/base/text.h"
#include "meshreel/tune/effort.h"

namespace meshreel {

namespace {

Error goal_usage(std::string message)
{
    return {ErrorCode::usage, std::move(message), {}, {}, {}};
}

using NamedTarget = std::pair<const char*, std::optional<double>>;

std::vector<NamedTarget> targets_of(const Quality& quality)
{
    return {{"kg", quality.kg},
            {"sted", quality.sted},
            {"max_error", quality.max_error},
            {"max_error_relative", quality.max_error_relative},
            {"psnr", quality.psnr},
            {"size", quality.size ? std::optional(static_cast<double>(*quality.size)) : std::nullopt},
            {"bpfv", quality.bpfv}};
}

Status check_quality(const Quality& quality)
{
    std::vector<const char*> asked;
    for (const auto& [name, value] : targets_of(quality)) {
        if (value) asked.push_back(name);
        if (value && !(*value > 0 && std::isfinite(*value))) return goal_usage(concat(name, " must be above 0"));
    }
    if (quality.bases) asked.push_back("bases");
    if (quality.step) asked.push_back("step");
    const bool by_hand = asked.size() == 2 && quality.bases && quality.step;
    if (asked.size() > 1 && !by_hand)
        return goal_usage(concat(asked[0], " and ", asked[1], " exclude each other: one target, or bases and step"));
    if (quality.step && !(*quality.step > 0 && std::isfinite(*quality.step))) return goal_usage("step must be above 0");
    if (quality.bases && *quality.bases == 0) return goal_usage("bases must be above 0");
    return Ok{};
}

Status check_effort(int effort)
{
    if (effort >= tune::least_effort && effort <= tune::most_effort) return Ok{};
    return goal_usage(concat("effort must be ", tune::least_effort, " to ", tune::most_effort, ", not ", effort));
}

Status check_base(const Animation& animation, const EncodeOptions& options)
{
    if (options.order != Order::base)
        return options.base == nullptr ? Status(Ok{}) : goal_usage("a base mesh is given, but the order is not base");
    if (options.base == nullptr) return goal_usage("order base needs a base mesh");
    if (options.base->vertex_count != animation.vertex_count)
        return goal_usage(concat("the base mesh has ", options.base->vertex_count, " vertices, the animation ",
                                 animation.vertex_count));
    if (options.base->triangles != animation.triangles)
        return goal_usage("the base mesh has other triangles than the animation");
    return Ok{};
}

} // namespace

Status check_options(const Animation& still, const EncodeOptions& options)
{
    MESHREEL_CHECK(check_quality(options.quality));
    MESHREEL_CHECK(check_effort(options.effort));
    return check_base(still, options);
}

bool asks_anything(const Quality& quality)
{
    if (quality.bases || quality.step) return true;
    for (const auto& [name, value] : targets_of(quality))
        if (value) return true;
    return false;
}

Measures allowed_by(const Quality& quality, const Animation& animation, double diagonal)
{
    Measures allowed{no_limit, no_limit, no_limit, no_limit, no_limit};
    const double F = static_cast<double>(animation.frame_count()), V = animation.vertex_count;
    if (quality.kg) allowed.kg = *quality.kg;
    if (quality.sted) allowed.sted = *quality.sted;
    if (quality.max_error) allowed.max_error = *quality.max_error;
    if (quality.max_error_relative) allowed.max_error = *quality.max_error_relative / 100 * diagonal;
    if (quality.psnr) allowed.rms = diagonal * std::pow(10.0, -*quality.psnr / 20); // (5.1)
    if (quality.size) allowed.bytes = static_cast<double>(*quality.size);
    if (quality.bpfv) allowed.bytes = *quality.bpfv * F * V / 8; // (9.1)
    const std::vector<NamedTarget> targets = targets_of(quality);
    if (std::ranges::any_of(targets, [](const NamedTarget& target) { return target.second.has_value(); }))
        return allowed;
    const bool edges = !animation.triangles.empty();
    if (edges) allowed.sted = unseen_sted;
    allowed.max_error = (edges ? unseen_percent : unseen_points_percent) / 100 * diagonal;
    return allowed;
}

double excess_of(const Measures& reached, const Measures& allowed)
{
    const auto share = [](double is, double may) { return std::isfinite(may) ? is / may : 0.0; };
    return std::max({share(reached.kg, allowed.kg), share(reached.rms, allowed.rms),
                     share(reached.max_error, allowed.max_error), share(reached.sted, allowed.sted),
                     share(reached.bytes, allowed.bytes)});
}

} // namespace meshreel
