/// The one table of metrics, and the question whether two animations can be compared.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>

#include "meshreel/base/text.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/vertex_error.h"

namespace meshreel::metrics {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Invariance all_three{true, true, true}, but_rotation{true, false, true}, but_scale{true, true, false};

constexpr std::array table{
    Metric{"kg", "KG error", "%", "thesis (5.2)", 0.0, all_three, kg_error},
    Metric{"rms", "RMS error", "units", "root mean squared vertex distance", 0.0, but_scale, rms_error},
    Metric{"max_error", "largest error", "units", "largest vertex distance", 0.0, but_scale, max_error},
    Metric{"max_error_relative", "largest error", "% of the body diagonal", "largest vertex distance", 0.0,
           but_rotation, max_error_relative},
    Metric{"psnr", "PSNR", "dB", "thesis 5.1, as 10 log10(D^2 / MSE)", infinity, but_rotation, psnr},
    Metric{"sted", "STED", "", "thesis (7.4)-(7.14)", 0.0, all_three, sted_error},
};

} // namespace

std::span<const Metric> all()
{
    return table;
}

const Metric* find(std::string_view name)
{
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const Metric& metric) { return metric.name == name; });
    return found == table.end() ? nullptr : &*found;
}

Status comparable(const Animation& original, const Animation& distorted)
{
    if (original.vertex_count != distorted.vertex_count)
        return bad_input(
            concat("the original has ", original.vertex_count, " vertices, the other ", distorted.vertex_count),
            "vertex_count");
    if (original.frame_count() != distorted.frame_count())
        return bad_input(
            concat("the original has ", original.frame_count(), " frames, the other ", distorted.frame_count()),
            "frame_count");
    if (original.triangles.size() != distorted.triangles.size())
        return bad_input(concat("the original has ", original.triangles.size(), " triangles, the other ",
                                distorted.triangles.size()),
                         "triangles");
    for (std::size_t t = 0; t < original.triangles.size(); ++t)
        if (original.triangles[t] != distorted.triangles[t])
            return bad_input(concat("triangle ", t, " is another one in the other animation"), "triangles");
    return Ok{};
}

} // namespace meshreel::metrics
