/// The one table of metrics, and the question whether two animations can be compared.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "meshreel/base/text.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/metric.h"

namespace meshreel::metrics {

namespace {

constexpr std::array table{
    Metric{"kg", "KG error", "%", "thesis (5.2)", kg_error},
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
