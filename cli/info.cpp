/// info: a quick look at a file; the positions of a .reel file are not decoded.
// SPDX-License-Identifier: MIT
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/figures.h"
#include "cli/reel_file.h"
#include "cli/source.h"
#include "cli/verb.h"
#include "meshreel/base/file.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

const char* order_name(Order order)
{
    return order == Order::keep ? "keep" : order == Order::free ? "free" : "base";
}

Json reel_json(const Source& source, const Info& what, std::size_t file_bytes)
{
    Json figures{{"schema", "meshreel.info/1"}, {"file", source.path}, {"format", "reel"}};
    figures["vertices"] = what.vertices;
    figures["triangles"] = what.triangles;
    figures["frames"] = what.frames;
    figures["start_s"] = what.start_s;
    figures["end_s"] = what.end_s;
    figures["attributes"] = what.attributes;
    figures["materials"] = what.materials;
    figures["groups"] = what.groups;
    figures["assets"] = what.assets;
    figures["meta"] = meta_json(what.meta);
    figures["version"] = fmt::format("{}.{}", what.version_major, what.version_minor);
    figures["encoder"] = what.encoder;
    figures["codec"] = what.codec;
    figures["order"] = order_name(what.order);
    figures["coded_vertices"] = what.coded_vertices;
    figures["file_bytes"] = file_bytes;
    figures["decoded_bytes"] = what.decoded_bytes;
    figures["warnings"] = what.warnings;
    const double samples = static_cast<double>(what.vertices) * static_cast<double>(what.frames);
    figures["bpfv"] = samples > 0.0 ? Json(8.0 * static_cast<double>(file_bytes) / samples) : Json(nullptr);
    figures["chunks"] = Json::array();
    for (const Info::Chunk& chunk : what.chunks)
        figures["chunks"].push_back({{"type", chunk.type}, {"offset", chunk.offset}, {"size", chunk.size}});
    for (std::size_t n = 0; n < what.level_bytes.size(); ++n)
        figures["levels"].push_back({{"level", n}, {"bytes", what.level_bytes[n]}});
    return figures;
}

/// Null where a level has no surface left.
Json percent_json(double percent)
{
    return std::isfinite(percent) ? Json(percent) : Json(nullptr);
}

void add_levels(Json& figures, const std::vector<LevelInfo>& levels)
{
    for (std::size_t n = 0; n < levels.size(); ++n) {
        Json& level = figures["levels"][n];
        level["vertices"] = levels[n].vertices;
        level["triangles"] = levels[n].triangles;
        level["rms_error_relative"] = percent_json(levels[n].rms_error);
        level["max_error_relative"] = percent_json(levels[n].max_error);
    }
}

std::string levels_text(const std::vector<LevelInfo>& levels)
{
    std::string text = "  level  vertices  triangles  bytes of the file       rms error  largest, % of the diagonal\n";
    for (std::size_t n = 0; n < levels.size(); ++n) {
        const LevelInfo& level = levels[n];
        text += fmt::format("  {:>5} {:>9} {:>10} {:>10}  {:>6.2f} % {:>12.3f} {:>8.3f}\n", n, level.vertices,
                            level.triangles, level.bytes,
                            100 * static_cast<double>(level.bytes) / static_cast<double>(levels.front().bytes),
                            level.rms_error, level.max_error);
    }
    return text;
}

std::string reel_text(const Source& source, const Info& what, std::size_t file_bytes)
{
    std::string text = fmt::format("{}: reel {}.{}, codec {}, written by {}\n", source.path, what.version_major,
                                   what.version_minor, what.codec, what.encoder);
    text += fmt::format("  vertices    {} ({} coded), order {}\n", human_count(what.vertices),
                        human_count(what.coded_vertices), order_name(what.order));
    text += fmt::format("  triangles   {}\n  frames      {}, {:.6g} s to {:.6g} s\n", human_count(what.triangles),
                        human_count(what.frames), what.start_s, what.end_s);
    if (what.meta.fps > 0.0) text += fmt::format("  fps         {:.6g}\n", what.meta.fps);
    if (!what.meta.name.empty()) text += fmt::format("  name        {}\n", what.meta.name);
    if (!what.attributes.empty()) text += fmt::format("  attributes  {}\n", fmt::join(what.attributes, ", "));
    if (!what.materials.empty()) text += fmt::format("  materials   {}\n", fmt::join(what.materials, ", "));
    if (!what.groups.empty()) text += fmt::format("  groups      {}\n", fmt::join(what.groups, ", "));
    if (!what.assets.empty()) text += fmt::format("  assets      {}\n", fmt::join(what.assets, ", "));
    text += fmt::format("  size        {}\n", human_bytes(static_cast<double>(file_bytes)));
    if (what.level_bytes.size() > 1)
        text += fmt::format("  levels      {}, the coarsest in {}; see --levels\n", what.level_bytes.size(),
                            human_bytes(static_cast<double>(what.level_bytes.back())));
    for (const Info::Chunk& chunk : what.chunks)
        text += fmt::format("  chunk       {:<6} at {:>10}, {} bytes\n", chunk.type, chunk.offset, chunk.size);
    return text;
}

class InfoVerb : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("FILE", source_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        declare_format(app, "--format", source_.format, "the file's format, where its name does not say it");
        app.add_flag("--levels", levels_, "measure the levels of detail of a .reel file, which decodes them");
        source_.declare(app);
        app.footer("Examples:\n"
                   "  meshreel info walk.reel\n"
                   "  meshreel info walk.reel --levels\n"
                   "  meshreel info walk.glb --json\n"
                   "  meshreel info motion.pc2 --mesh mesh.obj\n");
    }

    Result<Report> run(Console& console) override
    {
        if (source_.is_reel()) return look_at_reel(console);
        MESHREEL_TRY(const Animation animation, load(source_, console));
        Json figures{{"schema", "meshreel.info/1"}, {"file", source_.path}, {"format", source_.format_name()}};
        add_counts(figures, animation);
        add_contents(figures, animation);
        return Report{figures,
                      fmt::format("{}: {}: {}\n{}", source_.path, source_.format_name(), counts_text(animation),
                                  contents_text(animation)),
                      true};
    }

private:
    Result<Report> look_at_reel(Console& console) const
    {
        MESHREEL_TRY(const Bytes bytes, read_file(source_.path, source_.limits));
        MESHREEL_TRY(const Info what, in_file(info(bytes, source_.limits), source_.path));
        for (const std::string& warning : what.warnings) console.warn(source_.path + ": " + warning);
        Report report{reel_json(source_, what, bytes.size()), reel_text(source_, what, bytes.size()), true};
        if (!levels_) return report;
        MESHREEL_TRY(const Animation base, load_base(source_, console));
        const DecodeOptions options{.base = source_.base.empty() ? nullptr : &base,
                                    .limits = source_.limits,
                                    .threads = source_.threads,
                                    .progress = console.progress()};
        MESHREEL_TRY(const std::vector<LevelInfo> all, in_file(levels(bytes, options), source_.path));
        add_levels(report.figures, all);
        report.text += levels_text(all);
        return report;
    }

    Source source_;
    bool levels_ = false;
};

} // namespace

std::unique_ptr<Verb> make_info()
{
    return std::make_unique<InfoVerb>();
}

} // namespace meshreel::cli
