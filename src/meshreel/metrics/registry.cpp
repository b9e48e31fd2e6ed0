/// The one table of measures, and the question whether two animations can be compared.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <string>

#include "meshreel/base/text.h"
#include "meshreel/metrics/da.h"
#include "meshreel/metrics/error_vectors.h"
#include "meshreel/metrics/hausdorff.h"
#include "meshreel/metrics/hausdorff_4d.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/metric.h"
#include "meshreel/metrics/sted.h"
#include "meshreel/metrics/td.h"
#include "meshreel/metrics/vertex_error.h"

namespace meshreel::metrics {

namespace {

/// The place of a parameter, or how many there are where there is none of that name.
std::size_t parameter_place(const Metric& metric, std::string_view name)
{
    const auto found = std::ranges::find(metric.parameters, name, &Parameter::name);
    return static_cast<std::size_t>(found - metric.parameters.begin());
}

std::string text_of(double number)
{
    std::array<char, 32> room{};
    return {room.data(), std::to_chars(room.data(), room.data() + room.size(), number).ptr};
}

Status differ(const char* what, std::size_t original, std::size_t distorted, const char* field)
{
    if (original == distorted) return Ok{};
    return bad_input(concat("the original has ", original, " ", what, ", the other ", distorted), field);
}

} // namespace

std::span<const Metric> all()
{
    static const std::array table{
        vertex_error_row(), kg_row(),   da_row(),        td_row(),           ev_row(),
        wev_row(),          sted_row(), hausdorff_row(), hausdorff_4d_row(),
    };
    return table;
}

const Metric* find(std::string_view name)
{
    const auto found = std::ranges::find(all(), name, &Metric::name);
    return found == all().end() ? nullptr : &*found;
}

FoundValue find_value(std::string_view name)
{
    for (const Metric& metric : all())
        for (std::size_t i = 0; i < metric.values.size(); ++i)
            if (metric.values[i].name == name) return {&metric, i};
    return {};
}

double Context::parameter(std::string_view name) const
{
    const std::size_t place = parameter_place(metric, name);
    assert(place < parameters.size());
    return parameters[place];
}

std::vector<double> usual_parameters(const Metric& metric)
{
    std::vector<double> parameters;
    for (const Parameter& parameter : metric.parameters) parameters.push_back(parameter.usual);
    return parameters;
}

Status set_parameter(const Metric& metric, std::string_view name, double value, std::span<double> parameters)
{
    const std::size_t place = parameter_place(metric, name);
    if (place == metric.parameters.size()) {
        std::string known;
        for (const Parameter& parameter : metric.parameters) known += concat(known.empty() ? "" : ", ", parameter.name);
        return Error{ErrorCode::usage, concat(metric.name, " has no parameter ", name, "; it has ",
                                              known.empty() ? std::string("none") : known)};
    }
    const Parameter& parameter = metric.parameters[place];
    if (!(value >= parameter.least && value <= parameter.most) || (parameter.whole && std::floor(value) != value))
        return Error{ErrorCode::usage,
                     concat(metric.name, ".", name, " must be a ", parameter.whole ? "whole " : "", "number from ",
                            text_of(parameter.least), " to ", text_of(parameter.most))};
    parameters[place] = value;
    return Ok{};
}

Status comparable(const Animation& original, const Animation& distorted, Common common)
{
    const bool triangles = common == Common::triangles;
    if (triangles) MESHREEL_CHECK(differ("vertices", original.vertex_count, distorted.vertex_count, "vertex_count"));
    if (common != Common::nothing)
        MESHREEL_CHECK(differ("frames", original.frame_count(), distorted.frame_count(), "frame_count"));
    if (!triangles) return Ok{};
    MESHREEL_CHECK(differ("triangles", original.triangles.size(), distorted.triangles.size(), "triangles"));
    for (std::size_t t = 0; t < original.triangles.size(); ++t)
        if (original.triangles[t] != distorted.triangles[t])
            return bad_input(concat("triangle ", t, " is another one in the other animation"), "triangles");
    return Ok{};
}

} // namespace meshreel::metrics
