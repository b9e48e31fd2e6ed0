/// compare: every metric of two animations, and whether thresholds hold.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/source.h"
#include "cli/verb.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/metric.h"

namespace meshreel::cli {

namespace {

/// A decibel is the only unit of which more is better.
bool more_is_better(const metrics::Metric& metric)
{
    return metric.unit == "dB";
}

/// A bound on one metric, from the command line.
struct Threshold {
    const metrics::Metric* metric;
    std::string option;
    std::optional<double> limit;

    bool met(double value) const { return more_is_better(*metric) ? value >= *limit : value <= *limit; }
};

/// "--max-kg", "--min-psnr"; "--max-error" for a metric called max_error.
std::string option_of(const metrics::Metric& metric)
{
    std::string name(metric.name);
    std::replace(name.begin(), name.end(), '_', '-');
    if (name.starts_with("max-")) name.erase(0, 4);
    return (more_is_better(metric) ? "--min-" : "--max-") + name;
}

/// A file of positions alone; the triangles it has were lent to it.
bool is_point_cache(const Source& source)
{
    return source.format_name() == "pc2" || source.format_name() == "mdd";
}

struct Measured {
    const metrics::Metric* metric;
    double value;
};

std::string table(const std::vector<Measured>& all)
{
    std::string text;
    for (const auto& [metric, value] : all)
        text += fmt::format("  {:<28} {:>14.8g} {:<6} {}\n", metric->title, value, metric->unit, metric->source);
    return text;
}

class Compare : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("ORIGINAL", original_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        app.add_option("DISTORTED", distorted_path_, "the same animation after whatever was done to it")->required();
        declare_format(app, "--format", format_, "the format of -, or of both where their names do not say it");
        std::vector<std::string> names;
        for (const metrics::Metric& metric : metrics::all()) names.emplace_back(metric.name);
        app.add_option("--metric", chosen_, "only this metric; may be repeated; default: all")
            ->check(one_of(names))
            ->type_name("NAME");
        app.add_option("--order", order_, "free: DISTORTED is a point cache decoded from a file made with --order free")
            ->check(one_of({"keep", "free"}))
            ->capture_default_str()
            ->type_name("keep|free");
        original_.declare(app);
        for (const metrics::Metric& metric : metrics::all()) {
            Threshold& threshold = thresholds_.emplace_back(Threshold{&metric, option_of(metric), {}});
            app.add_option(threshold.option, threshold.limit,
                           fmt::format("exit 7 where the {} is {} this{}{}", metric.title,
                                       more_is_better(metric) ? "below" : "above", metric.unit.empty() ? "" : ", ",
                                       metric.unit))
                ->type_name("X")
                ->group("Thresholds");
        }
        app.footer("Examples:\n"
                   "  meshreel compare walk.glb walk.reel\n"
                   "  meshreel compare motion.pc2 back.pc2 --mesh mesh.obj --max-kg 0.1\n"
                   "  meshreel compare a.reel b.reel --metric kg --json\n"
                   "  meshreel compare motion.pc2 free.pc2 --mesh mesh.obj --order free\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        Source distorted_source = original_;
        distorted_source.path = distorted_path_;
        complete(original_);
        complete(distorted_source);
        MESHREEL_TRY(Animation original, load(original_, console));
        MESHREEL_TRY(Animation distorted, load(distorted_source, console));
        const bool free = is_free(original, distorted, distorted_source);
        if (free) original = in_free_order(original, original_.threads);
        if (free && is_point_cache(distorted_source)) distorted.triangles = original.triangles;
        MESHREEL_CHECK(in_file(metrics::comparable(original, distorted), distorted_path_));
        const std::vector<Measured> measured = measure(original, distorted, console);
        Json figures{{"schema", "meshreel.compare/1"}, {"original", original_.path}, {"distorted", distorted_path_}};
        add_counts(figures, original);
        figures["order"] = free ? "free" : "keep";
        figures["metrics"] = Json::object();
        figures["units"] = Json::object();
        for (const auto& [metric, value] : measured) {
            figures["metrics"][std::string(metric->name)] = number(value);
            figures["units"][std::string(metric->name)] = metric->unit;
        }
        Report report{figures, {}, true};
        report.text = fmt::format("{} against {}: {}\n", distorted_path_, original_.path, counts_text(original));
        report.text += table(measured);
        judge(measured, report);
        report.figures["seconds"] = watch.seconds();
        report.figures["peak_memory_bytes"] = peak_memory_bytes();
        return report;
    }

private:
    /// --format is for standard input and for names that say nothing; it overrules no extension. --fps is for the one
    /// of the two that is no .reel file.
    void complete(Source& source) const
    {
        if (source.format_name().empty()) source.format = format_;
        if (source.is_reel()) source.fps = 0.0;
    }

    /// Whether DISTORTED is numbered as a codec left it: said for a point cache, seen from the triangles of a file.
    bool is_free(const Animation& original, const Animation& distorted, const Source& source) const
    {
        if (order_ == "free") return true;
        const bool same_sizes = original.vertex_count == distorted.vertex_count &&
                                original.frame_count() == distorted.frame_count() &&
                                original.triangles.size() == distorted.triangles.size();
        if (!source.is_reel() || !same_sizes || original.triangles == distorted.triangles) return false;
        return in_free_order(original, original_.threads).triangles == distorted.triangles;
    }

    bool wanted(const metrics::Metric& metric) const
    {
        const auto same_metric = [&](const Threshold& threshold) {
            return threshold.metric == &metric && threshold.limit;
        };
        return chosen_.empty() || std::find(chosen_.begin(), chosen_.end(), metric.name) != chosen_.end() ||
               std::any_of(thresholds_.begin(), thresholds_.end(), same_metric);
    }

    std::vector<Measured> measure(const Animation& original, const Animation& distorted, Console& console) const
    {
        std::vector<Measured> all;
        const Progress progress = console.progress();
        double done = 0.0;
        for (const metrics::Metric& metric : metrics::all()) {
            report(progress, metric.title, done / static_cast<double>(metrics::all().size()));
            done += 1.0;
            if (wanted(metric)) all.push_back({&metric, metric.measure(original, distorted, original_.threads)});
        }
        return all;
    }

    /// Holds every threshold against what was measured.
    void judge(const std::vector<Measured>& measured, Report& report) const
    {
        report.figures["thresholds"] = Json::array();
        for (const Threshold& threshold : thresholds_) {
            if (!threshold.limit) continue;
            const auto same_metric = [&](const Measured& one) { return one.metric == threshold.metric; };
            const double value = std::find_if(measured.begin(), measured.end(), same_metric)->value;
            const bool met = threshold.met(value);
            report.figures["thresholds"].push_back({{"metric", threshold.metric->name},
                                                    {"limit", number(*threshold.limit)},
                                                    {"value", number(value)},
                                                    {"met", met}});
            if (met) continue;
            report.exit_code = static_cast<int>(ErrorCode::missed);
            if (!report.complaint.empty()) report.complaint += "; ";
            report.complaint += fmt::format("{} {}: {} is {:.8g} {}", threshold.option, *threshold.limit,
                                            threshold.metric->title, value, threshold.metric->unit);
        }
        report.figures["met"] = report.exit_code == 0;
    }

    Source original_;
    std::string distorted_path_;
    std::string format_;
    std::string order_ = "keep";
    std::vector<std::string> chosen_;
    std::deque<Threshold> thresholds_; ///< one a metric; options point into it
};

} // namespace

std::unique_ptr<Verb> make_compare()
{
    return std::make_unique<Compare>();
}

} // namespace meshreel::cli
