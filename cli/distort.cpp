/// distort: makes an animation worse in one stated way.
// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/source.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "meshreel/distort/distortion.h"

namespace meshreel::cli {

namespace {

std::string distortion_list()
{
    std::string text = "Kinds:\n";
    for (const distort::Distortion& row : distort::all()) text += fmt::format("  {:<19} {}\n", row.name, row.summary);
    return text;
}

/// What the amount was, for people and programs.
std::string_view unit_name(distort::Unit unit)
{
    return unit == distort::Unit::length ? "model units" : unit == distort::Unit::count ? "count" : "share";
}

class Distort : public Verb {
public:
    void declare(CLI::App& app) override
    {
        std::vector<std::string> names;
        for (const distort::Distortion& row : distort::all()) names.emplace_back(row.name);
        app.add_option("INPUT", source_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        app.add_option("OUTPUT", target_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        app.add_option("KIND", kind_, "what to do to it; listed below")->required()->check(one_of(names));
        add_parsed(
            app, {"--amount", "how much: a length as 0.5% of the body diagonal or in model units, a count, or a share"},
            amount_, parse_amount)
            ->required()
            ->type_name("X");
        app.add_option("--omega", request_.omega,
                       "of waves: radians a model unit (default: ten waves along the body "
                       "diagonal), or a frame (a wave every ten frames)")
            ->type_name("W");
        app.add_option("--seed", request_.seed, "of noise: another seed, other noise")
            ->capture_default_str()
            ->type_name("S");
        declare_format(app, "--from", source_.format, "the input's format, where its name does not say it");
        declare_format(app, "--to", target_.format, "the output's format, where its name does not say it");
        source_.declare(app);
        target_.declare(app);
        app.footer(distortion_list() + "\nSee docs/distortions.md.\n\nExamples:\n"
                                       "  meshreel distort walk.glb noisy.glb noise-vertex-frame --amount 0.2%\n"
                                       "  meshreel distort walk.glb wavy.glb sine-space --amount 1% --omega 12\n"
                                       "  meshreel distort motion.pc2 --mesh mesh.obj few.pc2 basis --amount 5\n"
                                       "  meshreel distort walk.glb light.glb simplify --amount 25%\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        const distort::Distortion& distortion = *distort::find(kind_); // checked while parsing
        MESHREEL_TRY(const Go go, prepare(target_, {source_.path, source_.mesh, source_.base}, console));
        Json figures{{"schema", "meshreel.distort/1"}, {"input", source_.path}, {"output", target_.path}};
        figures["skipped"] = go == Go::skip;
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const Animation original, load(source_, console));
        request_.threads = source_.threads;
        MESHREEL_TRY(request_.amount, amount_of(distortion, original));
        MESHREEL_TRY(const Animation distorted, distort::distort(distortion, original, request_));
        MESHREEL_CHECK(save(distorted, target_, console));
        figures["kind"] = distortion.name;
        figures["amount"] = request_.amount;
        figures["unit"] = unit_name(distortion.unit);
        figures["seed"] = distortion.has_seed ? Json(request_.seed) : Json(nullptr);
        add_counts(figures, distorted);
        figures["seconds"] = watch.seconds();
        figures["peak_memory_bytes"] = peak_memory_bytes();
        return Report{figures,
                      fmt::format("{} -> {}: {} {:.6g} ({}), {}\n", source_.path, target_.path, distortion.name,
                                  request_.amount, unit_name(distortion.unit), counts_text(distorted))};
    }

private:
    /// The amount in the distortion's unit. @fails usage: a percentage of a count.
    Result<double> amount_of(const distort::Distortion& distortion, const Animation& original) const
    {
        if (!amount_.percent) return amount_.value;
        if (distortion.unit == distort::Unit::count)
            return Error{ErrorCode::usage, fmt::format("the amount of {} is a count, not a percentage", kind_)};
        const double whole = distortion.unit == distort::Unit::length ? body_diagonal(original) : 1.0;
        return 0.01 * amount_.value * whole;
    }

    Source source_;
    std::string kind_;
    Amount amount_;
    distort::Request request_;
    Target target_;
};

} // namespace

std::unique_ptr<Verb> make_distort()
{
    return std::make_unique<Distort>();
}

} // namespace meshreel::cli
