/// validate: reads a file to its last byte and says what it is and what is wrong with it.
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/source.h"
#include "cli/topology.h"
#include "cli/verb.h"

namespace meshreel::cli {

namespace {

class Validate : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("FILE", source_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        declare_format(app, "--format", source_.format, "the file's format, where its name does not say it");
        source_.declare(app);
        app.footer("A file that cannot be opened exits 2, one that is wrong 3, one that needs a feature we lack 5.\n"
                   "What is unusual but legal (borders, non-manifold edges, duplicated triangles, ...) is told, not "
                   "refused.\n\n"
                   "Examples:\n"
                   "  meshreel validate walk.reel\n"
                   "  meshreel validate motion.pc2 --mesh mesh.obj\n"
                   "  meshreel validate walk.####.obj --json\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        source_.verify_all = true;
        const Result<Animation> animation = load(source_, console);
        Json figures{{"schema", "meshreel.validate/1"}, {"file", source_.path}, {"format", source_.format_name()}};
        Report report{figures, {}, true};
        if (animation.ok())
            describe_valid(*animation, report);
        else if (is_about_contents(animation.error()))
            describe_invalid(animation.error(), report);
        else
            return animation.error();
        report.figures["seconds"] = watch.seconds();
        report.figures["peak_memory_bytes"] = peak_memory_bytes();
        return report;
    }

private:
    static bool is_about_contents(const Error& error)
    {
        return error.code == ErrorCode::bad_input || error.code == ErrorCode::unsupported;
    }

    void describe_valid(const Animation& animation, Report& report) const
    {
        report.figures["valid"] = true;
        report.figures["problems"] = Json::array();
        add_counts(report.figures, animation);
        add_contents(report.figures, animation);
        report.figures["topology"] = topology_json(animation);
        report.text = fmt::format("{}: valid {}: {}\n", source_.path, source_.format_name(), counts_text(animation));
        report.text += contents_text(animation) + topology_text(animation);
    }

    void describe_invalid(const Error& error, Report& report) const
    {
        report.figures["valid"] = false;
        report.figures["problems"] = Json::array({error_json(error)});
        report.text = fmt::format("{}: not valid\n", source_.path);
        report.exit_code = static_cast<int>(error.code);
        report.complaint = error.sentence();
    }

    Source source_;
};

} // namespace

std::unique_ptr<Verb> make_validate()
{
    return std::make_unique<Validate>();
}

} // namespace meshreel::cli
