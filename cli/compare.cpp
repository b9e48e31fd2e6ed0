/// compare: measures of the difference between two animations, and whether bounds on them hold.
// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/choice.h"
#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/pictures/compare_pictures.h"
#include "cli/reel_file.h"
#include "cli/source.h"
#include "cli/verb.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

/// A file of positions alone; the triangles it has were lent to it.
bool is_point_cache(const Source& source)
{
    return source.format_name() == "pc2" || source.format_name() == "mdd";
}

Result<std::unique_ptr<FrameSource>> open_any(const Source& source, Console& console)
{
    return source.is_reel() ? open_reel(source, console) : open(source, console);
}

/// Frames with the triangles of other ones.
class LentTriangles : public FrameSource {
public:
    LentTriangles(FrameSource& source, const std::vector<Triangle>& triangles) : source_(source), still_(source.still())
    {
        still_.triangles = triangles;
    }
    const Animation& still() const override { return still_; }
    Result<MatrixView<const float>> frames(std::size_t first, std::size_t count, Matrix<float>& room) override
    {
        return source_.frames(first, count, room);
    }

private:
    FrameSource& source_;
    Animation still_;
};

/// The two, and what stands before them where the original had to be renumbered.
struct Compared {
    std::unique_ptr<FrameSource> original_file, distorted_file;
    std::unique_ptr<FrameSource> renumbered = {}, lent = {};

    FrameSource& original() const { return renumbered ? *renumbered : *original_file; }
    FrameSource& distorted() const { return lent ? *lent : *distorted_file; }
};

class Compare : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("ORIGINAL", original_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        app.add_option("DISTORTED", distorted_.path, "the same animation after whatever was done to it")->required();
        declare_format(app, "--format", format_, "the format of -, or of both where their names do not say it");
        choice_.declare(app);
        app.add_option("--order", order_, "free: DISTORTED is a point cache decoded from a file made with --order free")
            ->check(one_of({"keep", "free"}))
            ->capture_default_str()
            ->type_name("keep|free");
        original_.declare(app);
        choice_.declare_bounds(app);
        pictures_.declare(app);
        app.footer("Examples:\n"
                   "  meshreel compare walk.glb walk.reel\n"
                   "  meshreel compare motion.pc2 back.pc2 --mesh mesh.obj --fail-above kg=0.1,sted=0.01\n"
                   "  meshreel compare a.reel b.reel --metric kg,sted --set sted.window=3 --json\n"
                   "  meshreel compare motion.pc2 free.pc2 --mesh mesh.obj --order free\n"
                   "  meshreel compare a.glb a.reel --heatmap a.html --heat sted --curves a.svg --strip a.png\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        MESHREEL_TRY(const Compared compared, open_both(console));
        const Animation& still = compared.original().still();
        MESHREEL_TRY(std::vector<Taken> taken,
                     in_file(choice_.measures(still, compared.distorted().still()), distorted_.path));
        warn_of_differences(compared, console);
        const PictureInputs inputs{compared.original(), compared.distorted(), original_.path, distorted_.path};
        MESHREEL_CHECK(pictures_.prepare(inputs, console));
        MESHREEL_CHECK(measure(compared, taken, console));
        MESHREEL_CHECK(pictures_.draw(inputs, taken, console));
        Json figures{{"schema", "meshreel.compare/2"}, {"original", original_.path}, {"distorted", distorted_.path}};
        add_counts(figures, still);
        figures["order"] = compared.renumbered ? "free" : "keep";
        figures["metrics"] = Json::object();
        figures["values"] = values_json(taken);
        for (const Json& value : figures["values"])
            figures["metrics"][value["name"].get<std::string>()] = value["value"];
        Report report{figures, {}, true};
        report.text = fmt::format("{} against {}: {}\n", distorted_.path, original_.path, counts_text(still));
        report.text += values_text(taken);
        choice_.judge(taken, report);
        report.figures["pictures"] = pictures_.figures();
        report.figures["seconds"] = watch.seconds();
        report.figures["peak_memory_bytes"] = peak_memory_bytes();
        return report;
    }

private:
    Result<Compared> open_both(Console& console)
    {
        const std::string distorted_path = distorted_.path;
        distorted_ = original_;
        distorted_.path = distorted_path;
        complete(original_);
        complete(distorted_);
        Compared both;
        MESHREEL_TRY(both.original_file, open_any(original_, console));
        MESHREEL_TRY(both.distorted_file, open_any(distorted_, console));
        MESHREEL_TRY(const bool free, is_free(both));
        if (!free) return both;
        MESHREEL_TRY(both.renumbered, in_free_order(*both.original_file, original_.threads));
        if (is_point_cache(distorted_))
            both.lent = std::make_unique<LentTriangles>(*both.distorted_file, both.renumbered->still().triangles);
        return both;
    }

    /// --format is for standard input and for names that say nothing; it overrules no extension. --fps is for the one
    /// of the two that is no .reel file.
    void complete(Source& source) const
    {
        if (source.format_name().empty()) source.format = format_;
        if (source.is_reel()) source.fps = 0.0;
    }

    /// Whether DISTORTED is numbered as a codec left it: said for a point cache, seen from the triangles of a file.
    Result<bool> is_free(const Compared& both) const
    {
        if (order_ == "free") return true;
        const Animation &original = both.original_file->still(), &distorted = both.distorted_file->still();
        const bool same_sizes = original.vertex_count == distorted.vertex_count &&
                                original.frame_count() == distorted.frame_count() &&
                                original.triangles.size() == distorted.triangles.size();
        if (!distorted_.is_reel() || !same_sizes || original.triangles == distorted.triangles) return false;
        MESHREEL_TRY(const auto renumbered, in_free_order(*both.original_file, original_.threads));
        return renumbered->still().triangles == distorted.triangles;
    }

    /// Where the default leaves out what needs counterparts, it says so.
    void warn_of_differences(const Compared& compared, Console& console) const
    {
        const Status same = metrics::comparable(compared.original().still(), compared.distorted().still());
        if (!same.ok())
            console.warn(fmt::format("{}: {}; only measures that need no vertex' counterpart are taken",
                                     distorted_.path, same.error().message));
    }

    Status measure(const Compared& compared, std::vector<Taken>& taken, Console& console)
    {
        std::vector<metrics::Wanted> wanted;
        for (const Taken& one : taken) wanted.push_back(one.wanted);
        pictures_.listen(wanted);
        MESHREEL_TRY(std::vector<metrics::Measured> found,
                     in_file(metrics::measure(compared.original(), compared.distorted(), wanted,
                                              {original_.threads, console.progress()}),
                             distorted_.path));
        for (std::size_t i = 0; i < taken.size(); ++i) taken[i].found = std::move(found[i]);
        return Ok{};
    }

    Source original_, distorted_;
    std::string format_;
    std::string order_ = "keep";
    Choice choice_;
    ComparePictures pictures_;
};

} // namespace

std::unique_ptr<Verb> make_compare()
{
    return std::make_unique<Compare>();
}

} // namespace meshreel::cli
