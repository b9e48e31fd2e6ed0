/// convert: reads an animation in any format and writes it in any other.
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/source.h"
#include "cli/target.h"
#include "cli/verb.h"

namespace meshreel::cli {

namespace {

class Convert : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("INPUT", source_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        app.add_option("OUTPUT", target_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        declare_format(app, "--from", source_.format, "the input's format, where its name does not say it");
        declare_format(app, "--to", target_.format, "the output's format, where its name does not say it");
        source_.declare(app);
        target_.declare(app);
        app.footer("Examples:\n"
                   "  meshreel convert walk.glb walk.pc2 --fps 30 --mesh-out walk.obj\n"
                   "  meshreel convert motion.pc2 --mesh mesh.obj motion.####.ply\n"
                   "  meshreel convert walk.####.obj walk.glb --morphs pca\n"
                   "  meshreel convert walk.reel walk.mdd --frames 0:99\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        MESHREEL_TRY(const Go go, prepare(target_, {source_.path, source_.mesh, source_.base}, console));
        Json figures{{"schema", "meshreel.convert/1"}, {"input", source_.path}, {"output", target_.path}};
        figures["skipped"] = go == Go::skip;
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const Animation animation, load(source_, console));
        MESHREEL_CHECK(save(animation, target_, console));
        add_counts(figures, animation);
        figures["seconds"] = watch.seconds();
        figures["peak_memory_bytes"] = peak_memory_bytes();
        return Report{figures, fmt::format("{} -> {}: {}\n", source_.path, target_.path, counts_text(animation))};
    }

private:
    Source source_;
    Target target_;
};

} // namespace

std::unique_ptr<Verb> make_convert()
{
    return std::make_unique<Convert>();
}

} // namespace meshreel::cli
