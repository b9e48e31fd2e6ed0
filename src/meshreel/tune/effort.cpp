/// The table of efforts.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/effort.h"

#include <array>

namespace meshreel::tune {

namespace {

/// Of each effort: how seldom weights are found anew, how many of the knobs are varied, how often; how much lengths may
/// vary, in parts of the error, where relaxing is tried.
struct EffortRow {
    std::uint32_t growth;
    std::size_t knobs;
    int rounds;
    double telling;
};
constexpr std::array<EffortRow, most_effort> effort_rows{{
    {64, 0, 1, 0.1},
    {16, 0, 1, 0.1},
    {12, 0, 1, 0.1},
    {8, 0, 1, 0.1},
    {4, 1, 1, 0.1},
    {4, 3, 1, 0.5},
    {3, 4, 1, 0.5},
    {2, 5, 1, 0.5},
    {2, 5, 5, 0.5},
}};

} // namespace

Plan plan_of(int effort, Tune tune)
{
    const EffortRow& row = effort_rows[static_cast<std::size_t>(effort - least_effort)];
    Plan plan;
    // Errors of the basis are smooth over the surface, and so are components left out: STED hardly sees them.
    plan.start.truncation = tune == Tune::sted ? 0.9 : 0.36;
    plan.start.basis_ratio = tune == Tune::sted ? 2.8 : 1.4;
    plan.start.first_ratio = tune == Tune::sted ? 0.35 : 1.0;
    plan.start.bit_price = tune == Tune::sted ? 0.2 : 0.14;
    plan.start.growth = row.growth;
    plan.knobs = {{&codecs::Settings::linear, 3.0, 10.0, 4000.0}, // the one whose best differs most between motions
                  {&codecs::Settings::basis_ratio, 1.3, 0.2, tune == Tune::sted ? 2.8 : 2.0},
                  {&codecs::Settings::truncation, 1.3, 0.05, 2.0},
                  {&codecs::Settings::bit_price, 1.3, 0.01, 0.2},
                  {&codecs::Settings::first_ratio, 1.25, 0.2, 2.0}};
    plan.knobs.resize(row.knobs);
    plan.rounds = row.rounds;
    plan.telling = row.telling;
    return plan;
}

} // namespace meshreel::tune
