/// What people said and what was measured of the same stimuli: the table that a study is made from.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshreel/io/csv.h"

namespace meshreel::io {

/// One row: an animation that people saw.
struct Stimulus {
    std::string name;
    std::size_t dataset = 0; ///< in Scores::datasets
    double mos = 0.0;        ///< mean opinion score
};

/// One column of numbers.
struct ScoredMeasure {
    std::string name;
    std::vector<std::optional<double>> values; ///< [N], finite; nothing: an empty cell
};

struct Scores {
    std::string mos_name;
    std::vector<std::string> datasets;   ///< in the order of their first rows; one without a name where none is named
    std::vector<Stimulus> stimuli;       ///< [N], N > 0
    std::vector<ScoredMeasure> measures; ///< one at least
};

/// Which column is what. Empty: the one of a usual name, whatever its case.
struct ScoreColumns {
    std::string mos;     ///< "mos", "mean opinion score", "score"; must be there
    std::string dataset; ///< "dataset", "group", "sequence", "model"; may be missing: then all is one dataset
    std::string
        stimulus; ///< "stimulus", "name", "file"; else the first column left, where it is no number; may be missing
    std::vector<std::string> measures; ///< empty: all other columns
};

/// Makes numbers of a table's cells. Where the separator is not a comma, a number may have a decimal comma.
/// @fails usage: no column of that name; bad_input, naming line and column: no column of scores or none of measures, a cell that
/// is no finite number, a stimulus without score, the same stimulus of a dataset twice.
Result<Scores> read_scores(const Csv& csv, const ScoreColumns& columns = {});

} // namespace meshreel::io
