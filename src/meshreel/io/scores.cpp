/// Finds the columns by their names, then reads row after row.
// SPDX-License-Identifier: MIT
#include "meshreel/io/scores.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string_view>
#include <utility>

#include "meshreel/base/text.h"
#include "meshreel/io/text_scan.h"

namespace meshreel::io {

namespace {

/// Where the columns stand in the table.
struct ScorePlaces {
    std::size_t mos = 0;
    std::optional<std::size_t> dataset, stimulus;
    std::vector<std::size_t> measures;
};

std::string lowered(std::string text)
{
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

std::optional<std::size_t> place_of(const CsvRow& header, std::string_view name)
{
    const auto found = std::find(header.cells.begin(), header.cells.end(), name);
    if (found == header.cells.end()) return std::nullopt;
    return static_cast<std::size_t>(found - header.cells.begin());
}

/// The column that was asked for by name, else the first of a usual name, if any. @fails usage.
Result<std::optional<std::size_t>> column(const CsvRow& header, const std::string& asked,
                                          std::initializer_list<std::string_view> usual)
{
    if (!asked.empty()) {
        const std::optional<std::size_t> place = place_of(header, asked);
        if (place) return place;
        return Error{ErrorCode::usage, concat("there is no column ", in_quotes(asked))};
    }
    for (std::size_t i = 0; i < header.cells.size(); ++i)
        if (std::find(usual.begin(), usual.end(), lowered(header.cells[i])) != usual.end()) return std::optional(i);
    return std::optional<std::size_t>{};
}

/// A finite number; nothing: it is none.
std::optional<double> finite_number(std::string text, char separator)
{
    if (separator != ',' && std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos)
        std::replace(text.begin(), text.end(), ',', '.');
    const std::optional<double> value = to_double(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

/// The columns measured: those asked for, else all that are nothing else. @fails usage; bad_input: none.
Result<std::vector<std::size_t>> measured_columns(const Csv& csv, const ScorePlaces& places,
                                                  const std::vector<std::string>& asked)
{
    std::vector<std::size_t> all;
    for (const std::string& name : asked) {
        MESHREEL_TRY(const std::optional<std::size_t> place, column(csv.header, name, {}));
        all.push_back(*place);
    }
    for (std::size_t i = 0; asked.empty() && i < csv.header.cells.size(); ++i)
        if (i != places.mos && places.dataset != i && places.stimulus != i) all.push_back(i);
    if (all.empty()) return bad_input("there is no column of a measure", {}, at_line(csv.header.line));
    return all;
}

/// The first column that is nothing else, where its first cell is a name.
std::optional<std::size_t> unnamed_stimulus(const Csv& csv, const ScorePlaces& places)
{
    std::size_t first = 0;
    while (first == places.mos || first == places.dataset) ++first;
    if (first >= csv.header.cells.size()) return std::nullopt;
    const std::string& cell = csv.rows.front().cells[first];
    if (cell.empty() || finite_number(cell, csv.separator)) return std::nullopt;
    return first;
}

Result<ScorePlaces> find_columns(const Csv& csv, const ScoreColumns& columns)
{
    ScorePlaces places;
    MESHREEL_TRY(const std::optional<std::size_t> mos,
                 column(csv.header, columns.mos, {"mos", "mean opinion score", "score"}));
    if (!mos) return bad_input("there is no column 'MOS' of mean opinion scores", {}, at_line(csv.header.line));
    places.mos = *mos;
    MESHREEL_TRY(places.dataset, column(csv.header, columns.dataset, {"dataset", "group", "sequence", "model"}));
    MESHREEL_TRY(places.stimulus, column(csv.header, columns.stimulus, {"stimulus", "name", "file"}));
    if (!places.stimulus && columns.measures.empty()) places.stimulus = unnamed_stimulus(csv, places);
    MESHREEL_TRY(places.measures, measured_columns(csv, places, columns.measures));
    return places;
}

/// Rows become stimuli.
class ScoreReader {
public:
    ScoreReader(const Csv& csv, const ScorePlaces& places) : csv_(csv), places_(places)
    {
        scores_.mos_name = csv.header.cells[places.mos];
        for (const std::size_t place : places.measures) scores_.measures.push_back({csv.header.cells[place], {}});
    }

    Result<Scores> read()
    {
        for (const CsvRow& row : csv_.rows) {
            MESHREEL_CHECK(add_stimulus(row));
            for (std::size_t m = 0; m < places_.measures.size(); ++m) {
                MESHREEL_TRY(const std::optional<double> value, number(row, places_.measures[m]));
                scores_.measures[m].values.push_back(value);
            }
        }
        return std::move(scores_);
    }

private:
    Error wrong(const CsvRow& row, std::size_t place, std::string message) const
    {
        return bad_input(std::move(message), concat("column ", in_quotes(csv_.header.cells[place])), at_line(row.line));
    }

    /// Nothing: an empty cell.
    Result<std::optional<double>> number(const CsvRow& row, std::size_t place) const
    {
        const std::string& cell = row.cells[place];
        if (cell.empty()) return std::optional<double>{};
        const std::optional<double> value = finite_number(cell, csv_.separator);
        if (value) return value;
        return wrong(row, place, concat(in_quotes(cell), " is not a finite number"));
    }

    Result<std::size_t> dataset_of(const CsvRow& row)
    {
        const std::string name = places_.dataset ? row.cells[*places_.dataset] : "";
        if (places_.dataset && name.empty()) return wrong(row, *places_.dataset, "a stimulus without a dataset");
        const auto [found, is_new] = datasets_.emplace(name, scores_.datasets.size());
        if (is_new) scores_.datasets.push_back(name);
        return found->second;
    }

    Status add_stimulus(const CsvRow& row)
    {
        MESHREEL_TRY(const std::optional<double> mos, number(row, places_.mos));
        if (!mos) return wrong(row, places_.mos, "a stimulus without a score");
        const std::string name =
            places_.stimulus ? row.cells[*places_.stimulus] : concat("line ", static_cast<std::size_t>(row.line));
        MESHREEL_TRY(const std::size_t dataset, dataset_of(row));
        scores_.stimuli.push_back({name, dataset, *mos});
        const auto [earlier, is_new] = lines_.emplace(std::pair(dataset, name), row.line);
        if (is_new) return Ok{};
        return wrong(row, places_.stimulus.value_or(0),
                     concat(in_quotes(name), " is in line ", earlier->second, " already"));
    }

    const Csv& csv_;
    const ScorePlaces& places_;
    Scores scores_;
    std::map<std::string, std::size_t> datasets_;
    std::map<std::pair<std::size_t, std::string>, std::uint64_t> lines_; ///< of each stimulus
};

} // namespace

Result<Scores> read_scores(const Csv& csv, const ScoreColumns& columns)
{
    MESHREEL_TRY(const ScorePlaces places, find_columns(csv, columns));
    return ScoreReader(csv, places).read();
}

} // namespace meshreel::io
