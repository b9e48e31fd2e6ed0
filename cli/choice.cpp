/// Names, settings and bounds of measures, read from the command line.
// SPDX-License-Identifier: MIT
#include "cli/choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "cli/numbers.h"

namespace meshreel::cli {

namespace {

using metrics::Metric;

/// "kg=0.1".
struct Assignment {
    std::string name;
    double number = 0.0;
};

Result<Assignment> parse_assignment(const std::string& text)
{
    const std::size_t sign = text.find('=');
    Assignment result{text.substr(0, sign), 0.0};
    const char *const begin = text.data() + std::min(sign, text.size() - 1) + 1, *const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, result.number);
    if (sign == std::string::npos || error != std::errc{} || stop != end || !std::isfinite(result.number))
        return Error{ErrorCode::usage, fmt::format("'{}' is not NAME=NUMBER", text)};
    return result;
}

/// Names of measures and of their values, each once.
std::vector<std::string> known_names(bool measures)
{
    std::vector<std::string> names;
    const auto add = [&](std::string_view name) {
        if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
    };
    for (const Metric& metric : metrics::all()) {
        if (measures) add(metric.name);
        for (const metrics::Value& value : metric.values) add(value.name);
    }
    return names;
}

/// Accepts NAME=NUMBER, where a value has that name.
CLI::Validator bound_on_a_value()
{
    CLI::Validator validator;
    const CLI::Validator known = one_of(known_names(false));
    validator.name("NAME=X").operation([known](std::string& text) {
        const Result<Assignment> bound = parse_assignment(text);
        if (!bound.ok()) return bound.error().message;
        std::string name = bound->name;
        return known(name);
    });
    return validator;
}

/// Bounds are checked as they are read.
Assignment bound_of(const std::string& text)
{
    return *parse_assignment(text);
}

Result<std::vector<double>> parameters_of(const Metric& metric, const std::vector<std::string>& settings)
{
    std::vector<double> parameters = metrics::usual_parameters(metric);
    for (const std::string& text : settings) {
        MESHREEL_TRY(const Assignment setting, parse_assignment(text));
        const std::size_t dot = setting.name.find('.');
        const std::string owner = setting.name.substr(0, dot);
        if (dot == std::string::npos || metrics::find(owner) == nullptr)
            return Error{ErrorCode::usage, fmt::format("--set {}: no measure {}; write sted.window=3", text, owner)};
        if (owner != metric.name) continue;
        MESHREEL_CHECK(metrics::set_parameter(metric, setting.name.substr(dot + 1), setting.number, parameters));
    }
    return parameters;
}

} // namespace

void Choice::declare(CLI::App& app)
{
    std::vector<std::string> names = known_names(true);
    names.emplace_back("all");
    app.add_option("--metric", names_,
                   "a measure, or one of its values; all: the slow ones too; default: all but those")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(one_of(names))
        ->type_name("NAME");
    app.add_option("--set", settings_, "a parameter of a measure, such as sted.window=3")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("METRIC.PARAMETER=X");
}

void Choice::declare_bounds(CLI::App& app)
{
    const auto add = [&](const char* option, std::vector<std::string>& bounds, const char* help) {
        app.add_option(option, bounds, help)
            ->delimiter(',')
            ->allow_extra_args(false)
            ->check(bound_on_a_value())
            ->type_name("NAME=X,...")
            ->group("Bounds");
    };
    add("--fail-above", above_, "exit 7 where a value is above X: kg=0.1,sted=0.01");
    add("--fail-below", below_, "exit 7 where a value is below X: psnr=60");
}

bool Choice::bounds(const Metric& metric, std::size_t value) const
{
    const auto same = [&](const std::string& text) { return bound_of(text).name == metric.values[value].name; };
    return std::ranges::any_of(above_, same) || std::ranges::any_of(below_, same);
}

bool Choice::names(const Metric& metric, std::size_t value) const
{
    const auto same = [&](const std::string& name) {
        return name == metric.name || name == "all" || name == metric.values[value].name;
    };
    return names_.empty() ? !metric.slow : std::ranges::any_of(names_, same);
}

bool Choice::bounds(const Metric& metric) const
{
    for (std::size_t i = 0; i < metric.values.size(); ++i)
        if (bounds(metric, i)) return true;
    return false;
}

Result<Taken> Choice::taken(const Metric& metric, bool usual) const
{
    MESHREEL_TRY(std::vector<double> parameters, parameters_of(metric, settings_));
    Taken taken{{&metric, std::move(parameters)}, {}};
    for (std::size_t i = 0; i < metric.values.size(); ++i)
        if (usual || names(metric, i) || bounds(metric, i)) taken.shown.push_back(i);
    return taken;
}

Result<std::vector<Taken>> Choice::measures(const Animation& original, const Animation& distorted) const
{
    std::vector<Taken> all;
    const bool any = names_.empty() || std::ranges::find(names_, "all") != names_.end();
    const Status same = metrics::comparable(original, distorted);
    const bool surfaces = names_.empty() && !same.ok(); // then those that look at surfaces, slow or not
    for (const Metric& metric : metrics::all()) {
        const bool possible = metrics::comparable(original, distorted, metric.common).ok();
        MESHREEL_TRY(Taken taken, this->taken(metric, surfaces && metric.common == metrics::Common::frames));
        if (taken.shown.empty() || (any && !possible && !bounds(metric))) continue;
        all.push_back(std::move(taken));
    }
    if (!all.empty()) return all;
    Error error = same.error();
    error.message += "; there are measures that need less in common: --metric all";
    return error;
}

void Choice::judge(const std::vector<Taken>& all, Report& report) const
{
    report.figures["bounds"] = Json::array();
    const auto hold = [&](const std::string& text, bool above) {
        const Assignment bound = bound_of(text);
        const metrics::FoundValue found = metrics::find_value(bound.name);
        const auto taken =
            std::ranges::find_if(all, [&](const Taken& one) { return one.wanted.metric == found.metric; });
        const double value = taken->found.values[found.index];
        const bool met = above ? value <= bound.number : value >= bound.number;
        report.figures["bounds"].push_back({{"value", bound.name},
                                            {"fail", above ? "above" : "below"},
                                            {"limit", bound.number},
                                            {"found", number(value)},
                                            {"met", met}});
        if (met) return;
        const metrics::Value& described = found.metric->values[found.index];
        report.exit_code = static_cast<int>(ErrorCode::missed);
        if (!report.complaint.empty()) report.complaint += "; ";
        report.complaint += fmt::format("--fail-{} {}: {} is {:.8g} {}", above ? "above" : "below", text,
                                        described.title, value, described.unit);
    };
    for (const std::string& text : above_) hold(text, true);
    for (const std::string& text : below_) hold(text, false);
    report.figures["met"] = report.exit_code == 0;
}

Json values_json(const std::vector<Taken>& all)
{
    Json list = Json::array();
    for (const Taken& taken : all)
        for (const std::size_t i : taken.shown) {
            const Metric& metric = *taken.wanted.metric;
            const metrics::Value& value = metric.values[i];
            Json parameters = Json::object();
            for (std::size_t p = 0; p < metric.parameters.size(); ++p)
                parameters[std::string(metric.parameters[p].name)] = taken.wanted.parameters[p];
            list.push_back({{"name", value.name},
                            {"title", value.title},
                            {"value", number(taken.found.values[i])},
                            {"unit", value.unit},
                            {"better", value.better == metrics::Better::less ? "less" : "more"},
                            {"equal", number(value.equal)},
                            {"metric", metric.name},
                            {"parameters", parameters},
                            {"source", value.source}});
        }
    return list;
}

std::string values_text(const std::vector<Taken>& all)
{
    std::size_t name_width = 0, title_width = 0, unit_width = 0;
    const auto for_values = [&](const auto& visit) {
        for (const Taken& taken : all)
            for (const std::size_t i : taken.shown) visit(taken.wanted.metric->values[i], taken.found.values[i]);
    };
    for_values([&](const metrics::Value& value, double) {
        name_width = std::max(name_width, value.name.size());
        title_width = std::max(title_width, value.title.size());
        unit_width = std::max(unit_width, value.unit.size());
    });
    std::string text;
    for_values([&](const metrics::Value& value, double number) {
        text += fmt::format("  {:<{}}  {:<{}} {:>14.8g} {:<{}}  {}\n", value.name, name_width, value.title, title_width,
                            number, value.unit, unit_width, value.source);
    });
    return text;
}

} // namespace meshreel::cli
