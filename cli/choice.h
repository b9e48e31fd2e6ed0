/// Which measures a command line asks for, with what parameters, and what bounds it sets on their values.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/report.h"
#include "meshreel/metrics/measure.h"

namespace meshreel::cli {

/// A measure that was taken, and which of its values are shown.
struct Taken {
    metrics::Wanted wanted;
    std::vector<std::size_t> shown; ///< places in the metric's values, rising
    metrics::Measured found = {};
};

/// The options --metric, --set, --fail-above and --fail-below.
class Choice {
public:
    /// --metric and --set.
    void declare(CLI::App& app);
    /// --fail-above and --fail-below.
    void declare_bounds(CLI::App& app);

    /// The measures to take of two animations: those named, or else all but the slow ones; of two
    /// that have other vertices or triangles, those that look at surfaces.
    /// @fails usage: a parameter that there is not; bad_input: the two have not in common what any of them needs.
    Result<std::vector<Taken>> measures(const Animation& original, const Animation& distorted) const;

    /// Holds every bound against what was found: "bounds" and "met" of the figures, exit code and complaint.
    void judge(const std::vector<Taken>& all, Report& report) const;

private:
    bool names(const metrics::Metric& metric, std::size_t value) const;
    bool bounds(const metrics::Metric& metric, std::size_t value) const;
    bool bounds(const metrics::Metric& metric) const;
    /// The values shown are those named or bounded, or all where the measure is a usual one.
    Result<Taken> taken(const metrics::Metric& metric, bool usual) const;

    std::vector<std::string> names_, settings_, above_, below_;
};

/// Every value shown with its name, unit, parameters and direction.
Json values_json(const std::vector<Taken>& all);

/// A line for every value shown.
std::string values_text(const std::vector<Taken>& all);

} // namespace meshreel::cli
