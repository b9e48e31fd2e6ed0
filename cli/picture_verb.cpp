/// picture: draws two animations side by side.
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/pictures/picture.h"
#include "cli/source.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "meshreel/metrics/metric.h"

namespace meshreel::cli {

namespace {

/// The size of the file where it is a .reel, else of the bare floats.
std::string size_caption(const std::string& title, const Source& source, const Animation& animation)
{
    std::error_code none;
    const auto size = source.is_reel() ? std::filesystem::file_size(source.path, none) : raw_bytes(animation);
    if (none || !source.is_reel()) return fmt::format("{}\n{}", title, human_bytes(static_cast<double>(size)));
    const double values = static_cast<double>(animation.frame_count()) * animation.vertex_count;
    return fmt::format("{}\n{}\n{:.3g} bits a frame\nand vertex", title, human_bytes(static_cast<double>(size)),
                       8.0 * static_cast<double>(size) / values);
}

class Picture : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("ORIGINAL", original_.path, "a file or a sequence such as walk.####.obj")->required();
        app.add_option("DECODED", decoded_path_, "the same animation after whatever was done to it")->required();
        app.add_option("OUTPUT", target_.path, "an .svg file, or -")->required();
        app.add_option("--columns", picture_.frames, "how many frames are shown")
            ->capture_default_str()
            ->check(CLI::Range(1, 12))
            ->type_name("N");
        app.add_option("--up", up_, "which way is up; default: as the original says, else y")
            ->check(one_of({"x", "y", "z"}))
            ->type_name("x|y|z");
        app.add_option("--title", picture_.title, "a line over the picture")->type_name("TEXT");
        original_.declare(app);
        target_.declare_overwriting(app);
        app.footer("Examples:\n"
                   "  meshreel picture walk.glb walk.reel walk.svg\n"
                   "  meshreel picture motion.pc2 back.pc2 --mesh mesh.obj --columns 6 --up z both.svg\n");
    }

    Result<Report> run(Console& console) override
    {
        target_.format = "svg";
        Source decoded_source = original_;
        decoded_source.path = decoded_path_;
        if (decoded_source.is_reel()) decoded_source.fps = 0.0; // --fps speaks of the original then
        MESHREEL_TRY(const Go go, prepare(target_, {original_.path, decoded_path_}, console));
        Json figures{{"schema", "meshreel.picture/1"}, {"output", target_.path}, {"skipped", go == Go::skip}};
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const Animation original, load(original_, console));
        MESHREEL_TRY(const Animation decoded, load(decoded_source, console));
        MESHREEL_CHECK(in_file(metrics::comparable(original, decoded), decoded_path_));
        if (!up_.empty()) picture_.up = up_ == "x" ? Axis::x : up_ == "z" ? Axis::z : Axis::y;
        picture_.original = size_caption("original", original_, original);
        picture_.decoded = size_caption("decoded", decoded_source, decoded);
        MESHREEL_TRY(const std::string svg, comparison_picture(original, decoded, picture_));
        MESHREEL_CHECK(save_bytes(Bytes(svg.begin(), svg.end()), target_));
        return Report{figures,
                      fmt::format("{}: {} frames of {}\n", target_.path, picture_.frames, counts_text(original))};
    }

private:
    Source original_;
    std::string decoded_path_;
    std::string up_;
    Target target_;
    PictureOptions picture_;
};

} // namespace

std::unique_ptr<Verb> make_picture()
{
    return std::make_unique<Picture>();
}

} // namespace meshreel::cli
