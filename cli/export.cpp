/// export: one file that plays an animation wherever there is a browser.
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/source.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "cli/web/page_file.h"
#include "meshreel/base/file.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

class Export : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("FILE", source_.path, "a .reel file; anything else is encoded by defaults first")->required();
        app.add_option("--html", target_.path, "the page to write: player, decoder and animation in one file, or -")
            ->required()
            ->type_name("OUTPUT");
        app.add_option("--title", title_, "what stands above it; default: the file's name")->type_name("TEXT");
        app.add_option("--page", page_, "another page than the one that belongs to this command")->type_name("FILE");
        source_.declare(app);
        target_.declare_overwriting(app);
        app.footer("The page is opened from disk: it needs no server and fetches nothing.\n\nExamples:\n"
                   "  meshreel export --html walk.html walk.reel\n"
                   "  meshreel export --html walk.html walk.####.obj --fps 25\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        target_.format = "html";
        MESHREEL_TRY(const Go go, prepare(target_, {source_.path}, console));
        Json figures{{"schema", "meshreel.export/1"}, {"output", target_.path}, {"skipped", go == Go::skip}};
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const std::string page, load_page(page_));
        MESHREEL_TRY(const Bytes reel, reel_bytes(console));
        MESHREEL_TRY(const Info about, in_file(info(reel, source_.limits), source_.path));
        const std::string name = std::filesystem::path(source_.path).filename().string();
        const Json item{{"name", title_.empty() ? name : title_},
                        {"kind", "reel"},
                        {"url", "#item-0"},
                        {"bytes", reel.size()},
                        {"levels", about.level_bytes.size()}};
        const Json manifest{{"schema", "meshreel.play/1"}, {"items", Json::array({item})}};
        MESHREEL_TRY(const std::string filled, filled_page(page, manifest, {reel}));
        MESHREEL_CHECK(save_bytes(Bytes(filled.begin(), filled.end()), target_));
        figures["bytes"] = filled.size();
        figures["reel_bytes"] = reel.size();
        figures["seconds"] = watch.seconds();
        return Report{figures, fmt::format("{}: {}, of which {} is the animation\n", target_.path,
                                           human_bytes(static_cast<double>(filled.size())),
                                           human_bytes(static_cast<double>((reel.size() + 2) / 3 * 4)))};
    }

private:
    /// The file as it is, or what encode makes of it by default.
    Result<Bytes> reel_bytes(Console& console)
    {
        if (source_.is_reel() && source_.base.empty() && source_.as_stored()) {
            MESHREEL_TRY(Bytes reel, in_file(read_file(source_.path, source_.limits), source_.path));
            MESHREEL_CHECK(
                in_file(check_reel(reel, {.limits = source_.limits, .threads = source_.threads}), source_.path));
            return reel;
        }
        MESHREEL_TRY(const Animation animation, load(source_, console));
        EncodeOptions options;
        options.threads = source_.threads;
        options.progress = console.progress();
        MESHREEL_TRY(Encoded encoded, in_file(encode(animation, options), source_.path));
        return std::move(encoded.bytes);
    }

    Source source_;
    Target target_;
    std::string title_, page_;
};

} // namespace

std::unique_ptr<Verb> make_export()
{
    return std::make_unique<Export>();
}

} // namespace meshreel::cli
