/// generate: makes a sample animation.
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/hint.h"
#include "cli/numbers.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "meshreel/mesh/shapes.h"

namespace meshreel::cli {

namespace {

Error no_shape(const std::string& name)
{
    std::vector<std::string> names;
    for (const shapes::Shape& shape : shapes::all()) names.emplace_back(shape.name);
    const std::string near = nearest(name, names);
    const std::string hint = near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
    return {ErrorCode::usage, fmt::format("there is no shape '{}'; {}see meshreel generate --help", name, hint)};
}

class Generate : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("SHAPE", shape_, "what to make; listed below")->required();
        app.add_option("OUTPUT", target_.path, "a file, a sequence such as cloth.####.obj, or -")->required();
        app.add_option("--vertices", options_.vertices, "V, exactly")->capture_default_str()->type_name("N");
        app.add_option("--frames", options_.frames, "F, exactly")
            ->capture_default_str()
            ->check(positive())
            ->type_name("N");
        app.add_option("--fps", options_.fps, "frames a second")
            ->capture_default_str()
            ->check(positive())
            ->type_name("R");
        app.add_option("--seed", options_.seed, "another seed, another motion")->capture_default_str()->type_name("S");
        declare_format(app, "--format", target_.format, "the output's format, where its name does not say it");
        target_.declare(app);
        app.add_option("--mesh", target_.mesh_out, "the same as --mesh-out")->type_name("FILE")->group("Output");
        std::string text = "Shapes:\n";
        for (const shapes::Shape& shape : shapes::all())
            text += fmt::format("  {:<10} {}\n", shape.name, shape.summary);
        app.footer(text + "\nThe same options give the same bytes on every machine.\n\nExamples:\n"
                          "  meshreel generate cloth cloth.reel\n"
                          "  meshreel generate cloth cloth.####.obj --vertices 10000 --frames 200\n"
                          "  meshreel generate wave wave.pc2 --mesh wave.obj --seed 7\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        const shapes::Shape* const shape = shapes::find(shape_);
        if (shape == nullptr) return no_shape(shape_);
        MESHREEL_TRY(const Go go, prepare(target_, {}, console));
        Json figures{{"schema", "meshreel.generate/1"}, {"shape", shape_}, {"output", target_.path}};
        figures["skipped"] = go == Go::skip;
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const Animation animation, shapes::generate(*shape, options_));
        MESHREEL_CHECK(save(animation, target_, console));
        add_counts(figures, animation);
        figures["fps"] = options_.fps;
        figures["seed"] = options_.seed;
        figures["raw_bytes"] = raw_bytes(animation);
        figures["seconds"] = watch.seconds();
        figures["peak_memory_bytes"] = peak_memory_bytes();
        return Report{figures, fmt::format("{}: {}\n", target_.path, counts_text(animation))};
    }

private:
    std::string shape_;
    shapes::ShapeOptions options_;
    Target target_;
};

} // namespace

std::unique_ptr<Verb> make_generate()
{
    return std::make_unique<Generate>();
}

} // namespace meshreel::cli
