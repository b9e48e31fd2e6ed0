/// study: how well measures agree with what people saw.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/numbers.h"
#include "cli/scatter.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "meshreel/base/file.h"
#include "meshreel/io/scores.h"
#include "meshreel/metrics/correlation.h"

namespace meshreel::cli {

namespace {

/// The pairs of one measure and the score that a row of the result speaks of.
struct ScorePairs {
    std::vector<double> measured, scores;
};

/// One dataset and one measure, or all datasets together.
struct Agreement {
    std::string dataset, measure; ///< dataset empty: all of them
    std::size_t pairs = 0;
    std::vector<metrics::Correlation> coefficients; ///< one a row of metrics::coefficients()
};

/// Stimuli of a dataset that have a value of the measure. everything: of all datasets.
ScorePairs pairs_of(const io::Scores& scores, const io::ScoredMeasure& measure, std::size_t dataset, bool everything)
{
    ScorePairs pairs;
    for (std::size_t i = 0; i < scores.stimuli.size(); ++i) {
        if (!measure.values[i] || (!everything && scores.stimuli[i].dataset != dataset)) continue;
        pairs.measured.push_back(*measure.values[i]);
        pairs.scores.push_back(scores.stimuli[i].mos);
    }
    return pairs;
}

/// Every measure in every dataset, then, where there are several, in all together.
std::vector<Agreement> agreements(const io::Scores& scores)
{
    std::vector<Agreement> all;
    const std::size_t datasets = scores.datasets.size(), groups = datasets > 1 ? datasets + 1 : 1;
    for (std::size_t d = 0; d < groups; ++d) {
        const bool everything = d == datasets;
        for (const io::ScoredMeasure& measure : scores.measures) {
            const ScorePairs pairs = pairs_of(scores, measure, d, everything);
            Agreement one{everything ? "" : scores.datasets[d], measure.name, pairs.measured.size(), {}};
            for (const metrics::Coefficient& coefficient : metrics::coefficients())
                one.coefficients.push_back(coefficient.of(pairs.measured, pairs.scores));
            all.push_back(std::move(one));
        }
    }
    return all;
}

Json coefficient_json(const metrics::Correlation& correlation)
{
    Json json{{"value", nullptr}, {"low", nullptr}, {"high", nullptr}};
    if (correlation.value) json["value"] = *correlation.value;
    if (correlation.interval) {
        json["low"] = correlation.interval->low;
        json["high"] = correlation.interval->high;
    }
    if (!correlation.lacking.empty()) json["lacking"] = correlation.lacking;
    return json;
}

Json agreement_json(const Agreement& one)
{
    Json json{{"dataset", nullptr}, {"measure", one.measure}, {"pairs", one.pairs}};
    if (!one.dataset.empty()) json["dataset"] = one.dataset;
    for (std::size_t c = 0; c < one.coefficients.size(); ++c)
        json[std::string(metrics::coefficients()[c].name)] = coefficient_json(one.coefficients[c]);
    return json;
}

/// Three digits; no sign before 0.000.
std::string thousandths(double value)
{
    return fmt::format("{:6.3f}", std::abs(value) < 0.0005 ? 0.0 : value);
}

std::string coefficient_text(const metrics::Correlation& correlation)
{
    if (!correlation.value) return "-";
    const std::string value = thousandths(*correlation.value);
    if (!correlation.interval) return value;
    return fmt::format("{} [{}, {}]", value, thousandths(correlation.interval->low),
                       thousandths(correlation.interval->high));
}

/// What a row lacks, once each: "the measure is constant".
std::string remark_of(const Agreement& one)
{
    std::vector<std::string_view> seen;
    std::string text;
    for (const metrics::Correlation& correlation : one.coefficients) {
        if (correlation.lacking.empty() || std::find(seen.begin(), seen.end(), correlation.lacking) != seen.end())
            continue;
        seen.push_back(correlation.lacking);
        text += (text.empty() ? "" : "; ") + std::string(correlation.lacking);
    }
    return text;
}

std::string without_end_blanks(std::string line)
{
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

std::string agreement_table(const std::vector<Agreement>& all, bool several)
{
    std::size_t width = 12;
    for (const Agreement& one : all) width = std::max({width, one.measure.size(), one.dataset.size()});
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Agreement& one = all[i];
        if (i == 0 || one.dataset != all[i - 1].dataset) {
            const std::string name = one.dataset.empty() && several ? "all together" : one.dataset;
            std::string head = fmt::format("\n{:<{}}  {:>5}", name, width, "n");
            for (const metrics::Coefficient& coefficient : metrics::coefficients())
                head += fmt::format("  {:<23}", coefficient.title);
            text += without_end_blanks(head);
        }
        std::string line = fmt::format("{:<{}}  {:>5}", one.measure, width, one.pairs);
        for (const metrics::Correlation& correlation : one.coefficients)
            line += fmt::format("  {:<23}", coefficient_text(correlation));
        text += without_end_blanks(line + remark_of(one));
    }
    return text;
}

class Study : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("ACTION", action_, "correlate: measures with mean opinion scores")
            ->required()
            ->check(one_of({"correlate"}));
        app.add_option("SCORES", path_, "a table of comma, semicolon or tab separated values, or -")->required();
        app.add_option("--mos", columns_.mos, "the column of scores; default: MOS")->type_name("COLUMN");
        app.add_option("--dataset", columns_.dataset, "the column of datasets; default: dataset, if there is one")
            ->type_name("COLUMN");
        app.add_option("--stimulus", columns_.stimulus,
                       "the column of names; default: stimulus, name, file, or the "
                       "first, if it is no number")
            ->type_name("COLUMN");
        app.add_option("--measure", columns_.measures,
                       "only this measure; may be repeated; default: every other column")
            ->type_name("COLUMN");
        app.add_option("--plot", target_.path, "also draw every measure against the scores, as SVG")->type_name("FILE");
        target_.declare_overwriting(app);
        app.footer("Intervals are of 95 %. See docs/subjective.md for the table and the formulas.\n\nExamples:\n"
                   "  meshreel study correlate scores.csv\n"
                   "  meshreel study correlate scores.csv --measure kg --measure sted --plot scores.svg\n"
                   "  meshreel study correlate marks.tsv --mos mean --dataset clip --json\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        target_.format = "svg";
        const bool plots = !target_.path.empty();
        Go go = Go::skip;
        if (plots) {
            MESHREEL_TRY(go, prepare(target_, {path_}, console));
        }
        MESHREEL_TRY(const io::Scores scores, in_file(read(), path_));
        const std::vector<Agreement> all = agreements(scores);
        if (go == Go::on) {
            const std::string svg = scatter_picture(scores);
            MESHREEL_CHECK(save_bytes(Bytes(svg.begin(), svg.end()), target_));
        }
        Report report{summary(scores), {}, true};
        for (const Agreement& one : all) report.figures["correlations"].push_back(agreement_json(one));
        report.figures["seconds"] = watch.seconds();
        report.figures["peak_memory_bytes"] = peak_memory_bytes();
        report.text = fmt::format("{}: {} against {}, 95 % confidence intervals\n", path_,
                                  counted(scores.stimuli.size(), "stimulus", "stimuli"), scores.mos_name) +
                      agreement_table(all, scores.datasets.size() > 1);
        return report;
    }

private:
    Result<io::Scores> read() const
    {
        MESHREEL_TRY(const Bytes bytes, read_file(path_));
        MESHREEL_TRY(const io::Csv csv, io::parse_csv(bytes));
        return io::read_scores(csv, columns_);
    }

    Json summary(const io::Scores& scores) const
    {
        Json figures{{"schema", "meshreel.study/1"}, {"file", path_}, {"mos", scores.mos_name}, {"confidence", 0.95}};
        figures["stimuli"] = scores.stimuli.size();
        figures["datasets"] = scores.datasets;
        figures["correlations"] = Json::array();
        return figures;
    }

    std::string action_;
    std::string path_;
    io::ScoreColumns columns_;
    Target target_;
};

} // namespace

std::unique_ptr<Verb> make_study()
{
    return std::make_unique<Study>();
}

} // namespace meshreel::cli
