/// Any bytes as a table of scores: an error, or finite numbers and coefficients that are no NaN.
// SPDX-License-Identifier: MIT
#include <cmath>

#include "fuzz/io_round_trip.h"
#include "meshreel/io/scores.h"
#include "meshreel/metrics/correlation.h"

using namespace meshreel;

namespace {

void demand_coefficients(const io::Scores& scores, const io::ScoredMeasure& measure)
{
    std::vector<double> x, y;
    io::fuzz::demand(measure.values.size() == scores.stimuli.size());
    for (std::size_t i = 0; i < measure.values.size(); ++i) {
        if (!measure.values[i]) continue;
        x.push_back(*measure.values[i]);
        y.push_back(scores.stimuli[i].mos);
    }
    for (const metrics::Coefficient& coefficient : metrics::coefficients()) {
        const metrics::Correlation r = coefficient.of(x, y);
        io::fuzz::demand(r.value ? std::abs(*r.value) <= 1.0 : !r.lacking.empty());
        if (r.interval) io::fuzz::demand(r.interval->low >= -1.0 && r.interval->low <= r.interval->high);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto csv = io::parse_csv({data, size});
    if (!csv.ok()) return 0;
    const auto scores = io::read_scores(*csv);
    if (!scores.ok()) return 0;
    for (const io::ScoredMeasure& measure : scores->measures) demand_coefficients(*scores, measure);
    return 0;
}
