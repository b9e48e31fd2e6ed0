/// From options to wishes, and from what was heard to files.
// SPDX-License-Identifier: MIT
#include "cli/pictures/compare_pictures.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/numbers.h"
#include "cli/pictures/curves.h"

namespace meshreel::cli {

namespace {

std::string lower_extension(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& letter : extension)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return extension;
}

/// Accepts one of these words, or the number of a frame.
CLI::Validator word_or_frame(std::vector<std::string> words)
{
    return CLI::Validator(
        [words](const std::string& text) -> std::string {
            if (std::find(words.begin(), words.end(), text) != words.end()) return {};
            const bool number = !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == text.npos;
            return number ? std::string{}
                          : fmt::format("{} is neither a frame nor one of {}", text, fmt::join(words, ", "));
        },
        "");
}

CLI::Validator one_of_extensions(std::vector<std::string> extensions)
{
    return CLI::Validator(
        [extensions](const std::string& path) -> std::string {
            if (std::find(extensions.begin(), extensions.end(), lower_extension(path)) != extensions.end()) return {};
            return fmt::format("{} has none of the extensions {}", path, fmt::join(extensions, ", "));
        },
        "");
}

std::size_t frame_number(const std::string& digits)
{
    std::size_t frame = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), frame);
    return frame;
}

/// "units^3" as people write it.
std::string shown_unit(std::string_view unit)
{
    std::string shown(unit);
    for (const auto& [sign, power] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}})
        if (const std::size_t at = shown.find(sign); at != shown.npos) shown.replace(at, 2, power);
    return shown;
}

HeatOf heat_of(const std::string& text)
{
    if (text == "max") return {HeatOf::Kind::largest, 0};
    if (text == "mean") return {HeatOf::Kind::mean, 0};
    return {HeatOf::Kind::frame, frame_number(text)};
}

std::string file_name(const std::string& path)
{
    return std::filesystem::path(path).filename().string();
}

std::vector<std::string> heat_names()
{
    std::vector<std::string> names;
    for (const metrics::Metric& metric : metrics::all())
        if (!metric.vertex_title.empty()) names.emplace_back(metric.name);
    return names;
}

} // namespace

void ComparePictures::declare(CLI::App& app)
{
    const std::string group = "Pictures";
    app.add_option("--heatmap", heatmap_.target.path, "the error as the colour of the mesh: .html, .glb or .ply")
        ->check(one_of_extensions({".html", ".glb", ".ply"}))
        ->type_name("FILE")
        ->group(group);
    app.add_option("--heat", heat_name_, "the measure whose errors of vertices are shown; default: the distance")
        ->check(one_of(heat_names()))
        ->type_name("MEASURE")
        ->group(group);
    app.add_option("--heat-of", heat_of_text_, "glb, ply: the largest or the mean over all frames, or one frame")
        ->check(word_or_frame({"max", "mean"}))
        ->capture_default_str()
        ->type_name("max|mean|FRAME")
        ->group(group);
    app.add_option("--heat-top", range_, "the error at the top of the colour scale; default: a round one that fits all")
        ->check(positive())
        ->type_name("X")
        ->group(group);
    add_parsed(app, {"--heat-size", "html: leave out frames until the page is not larger; default 32M"}, page_bytes_,
               parse_memory)
        ->type_name("SIZE")
        ->group(group);
    app.add_option("--curves", curves_.target.path, "what was measured, frame by frame: .svg")
        ->check(one_of_extensions({".svg"}))
        ->type_name("FILE")
        ->group(group);
    app.add_option("--strip", strip_.target.path, "original, distorted and error from several sides: .png")
        ->check(one_of_extensions({".png"}))
        ->type_name("FILE")
        ->group(group);
    app.add_option("--strip-views", strip_options_.views, "how many sides")
        ->check(CLI::Range(1, 12))
        ->capture_default_str()
        ->type_name("N")
        ->group(group);
    app.add_option("--strip-frame", strip_frame_,
                   "the frame of the largest error, frames from first to last, or one frame")
        ->check(word_or_frame({"worst", "spread"}))
        ->capture_default_str()
        ->type_name("worst|spread|FRAME")
        ->group(group);
    app.add_option("--up", up_, "which way is up; default: as the original says, else y")
        ->check(one_of({"x", "y", "z"}))
        ->type_name("x|y|z")
        ->group(group);
    heatmap_.target.declare_overwriting(app);
}

Status ComparePictures::prepare(const PictureInputs& inputs, const Console& console)
{
    for (Output* output : {&heatmap_, &curves_, &strip_}) MESHREEL_CHECK(prepare_output(*output, inputs, console));
    if (!needs_heat()) return Ok{};
    of_ = heat_of(heat_of_text_);
    if (of_.kind == HeatOf::Kind::frame) MESHREEL_CHECK(check_frame(of_.frame, inputs));
    if (strip_frame_ != "worst" && strip_frame_ != "spread")
        MESHREEL_CHECK(check_frame(frame_number(strip_frame_), inputs));
    MESHREEL_CHECK(choose_measure(inputs));
    const std::string title = fmt::format("{} ({})", metric_->vertex_title, metric_->name);
    heat_ = std::make_unique<Heat>(HeatLabel{std::string(metric_->name), title, shown_unit(metric_->vertex_unit)},
                                   wishes(inputs));
    return Ok{};
}

Status ComparePictures::prepare_output(Output& output, const PictureInputs& inputs, const Console& console)
{
    if (output.target.path.empty()) return Ok{};
    output.target.overwrite = heatmap_.target.overwrite;
    output.target.skip_existing = heatmap_.target.skip_existing;
    output.target.format = lower_extension(output.target.path).substr(1);
    MESHREEL_TRY(const Go go, cli::prepare(output.target, {inputs.original_path, inputs.distorted_path}, console));
    output.wanted = go == Go::on;
    return Ok{};
}

Status ComparePictures::check_frame(std::size_t frame, const PictureInputs& inputs) const
{
    const std::size_t F = inputs.original.frame_count();
    if (frame < F) return Ok{};
    return Error{ErrorCode::usage, fmt::format("there is no frame {} among the {}, counted from 0", frame, F), {}, {}};
}

/// The measure asked for, or the first that the two allow.
Status ComparePictures::choose_measure(const PictureInputs& inputs)
{
    const auto fits = [&](const metrics::Metric& metric) {
        return metrics::comparable(inputs.original.still(), inputs.distorted.still(), metric.common);
    };
    if (!heat_name_.empty()) {
        metric_ = metrics::find(heat_name_);
        return in_file(fits(*metric_), inputs.distorted_path);
    }
    for (const metrics::Metric& metric : metrics::all())
        if (metric_ == nullptr && !metric.vertex_title.empty() && fits(metric).ok()) metric_ = &metric;
    if (metric_ != nullptr) return Ok{};
    return in_file(Status(bad_input("no measure of these two says anything of single vertices")),
                   inputs.distorted_path);
}

HeatWishes ComparePictures::wishes(const PictureInputs& inputs) const
{
    HeatWishes wishes;
    wishes.every_frame = heatmap_.wanted && heatmap_.target.format == "html";
    if (of_.kind == HeatOf::Kind::frame) wishes.frames.push_back(of_.frame);
    if (strip_.wanted && strip_frame_ != "worst")
        for (std::size_t f : strip_frames(inputs)) wishes.frames.push_back(f);
    return wishes;
}

/// The frame of each column.
std::vector<std::size_t> ComparePictures::strip_frames(const PictureInputs& inputs) const
{
    const std::size_t views = strip_options_.views, F = inputs.original.frame_count();
    if (strip_frame_ == "worst") return std::vector<std::size_t>(views, heat_->worst_frame());
    if (strip_frame_ != "spread") return std::vector<std::size_t>(views, frame_number(strip_frame_));
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < views; ++i) frames.push_back(views > 1 ? i * (F - 1) / (views - 1) : F / 2);
    return frames;
}

void ComparePictures::listen(std::vector<metrics::Wanted>& measures)
{
    if (!heat_) return;
    const auto asked = [&](const metrics::Wanted& wanted) { return wanted.metric == metric_; };
    auto found = std::find_if(measures.begin(), measures.end(), asked);
    if (found == measures.end()) found = measures.insert(measures.end(), metrics::Wanted{.metric = metric_});
    found->vertex_errors = [heat = heat_.get()](std::size_t frame, std::span<const double> errors) {
        heat->add(frame, errors);
    };
}

Status ComparePictures::draw(const PictureInputs& inputs, const std::vector<Taken>& taken, Console& console)
{
    if (curves_.wanted) MESHREEL_CHECK(draw_curves(inputs, taken));
    if (!heat_) return Ok{};
    Surfaces surfaces{&inputs.original, &inputs.distorted, heat_.get(), range_};
    surfaces.counterparts = metrics::comparable(inputs.original.still(), inputs.distorted.still()).ok();
    if (!up_.empty()) surfaces.up = up_ == "x" ? Axis::x : up_ == "z" ? Axis::z : Axis::y;
    if (strip_.wanted) MESHREEL_CHECK(draw_strip(surfaces, inputs));
    return heatmap_.wanted ? draw_heatmap(surfaces, inputs, console) : Status(Ok{});
}

Status ComparePictures::draw_heatmap(const Surfaces& surfaces, const PictureInputs& inputs, Console& console)
{
    HeatMapOptions options;
    options.of = of_;
    options.page_bytes = page_bytes_;
    options.original = file_name(inputs.original_path);
    options.distorted = file_name(inputs.distorted_path);
    options.warn = [&console](const std::string& text) { console.warn(text); };
    const std::string& kind = heatmap_.target.format;
    const auto make = kind == "html" ? heat_page : kind == "glb" ? heat_glb : heat_ply;
    MESHREEL_TRY(const Bytes file, in_file(make(surfaces, options), heatmap_.target.path));
    return save_bytes(file, heatmap_.target);
}

Status ComparePictures::draw_curves(const PictureInputs& inputs, const std::vector<Taken>& taken)
{
    std::vector<Curve> curves;
    for (const Taken& one : taken) {
        if (one.found.per_frame.empty()) continue;
        const metrics::Value& value = one.wanted.metric->values[0];
        curves.push_back({std::string(value.title), shown_unit(value.unit), one.found.values[0], one.found.per_frame,
                          value.better == metrics::Better::more});
    }
    if (curves.empty())
        return in_file(Status(Error{ErrorCode::usage, "none of the measures taken has a value for each frame", {}, {}}),
                       curves_.target.path);
    const std::string title =
        fmt::format("{} against {}", file_name(inputs.distorted_path), file_name(inputs.original_path));
    const std::string svg = curves_svg(curves, inputs.original.still().times_s, title);
    return save_bytes(Bytes(svg.begin(), svg.end()), curves_.target);
}

Status ComparePictures::draw_strip(const Surfaces& surfaces, const PictureInputs& inputs)
{
    StripOptions options = strip_options_;
    options.frames = strip_frames(inputs);
    MESHREEL_TRY(const Bytes file, in_file(turntable_strip(surfaces, options), strip_.target.path));
    return save_bytes(file, strip_.target);
}

Json ComparePictures::figures() const
{
    Json paths = Json::object();
    if (heatmap_.wanted) paths["heatmap"] = heatmap_.target.path;
    if (curves_.wanted) paths["curves"] = curves_.target.path;
    if (strip_.wanted) paths["strip"] = strip_.target.path;
    return paths;
}

} // namespace meshreel::cli
