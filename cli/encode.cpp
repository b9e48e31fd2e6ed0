/// encode: compresses an animation into a .reel file.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/reel_file.h"
#include "cli/source.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

constexpr const char* quality_group = "Quality, one of these (default: visually lossless, STED 0.02)";
constexpr const char* coding_group = "Coding";

/// What encode's options ask for, as texts; the table of the codec's own words.
struct Choices {
    std::string order = "keep", basis = "cobra", entropy = "range", codec = "reel", tune;

    Order order_value(bool has_base) const
    {
        return has_base ? Order::base : order == "free" ? Order::free : Order::keep;
    }
    BasisCoding basis_value() const
    {
        const auto place = std::find(basis_coding_names.begin(), basis_coding_names.end(), basis);
        return static_cast<BasisCoding>(place - basis_coding_names.begin());
    }
    std::optional<Tune> tune_value() const
    {
        return tune.empty() ? std::nullopt : std::optional(tune == "sted" ? Tune::sted : Tune::kg);
    }
    Entropy entropy_value() const { return entropy == "huffman" ? Entropy::huffman : Entropy::range; }
};

Result<std::uint32_t> parse_segment(const std::string& text)
{
    if (text == "auto") return std::uint32_t{0};
    if (text == "none") return one_segment;
    std::uint32_t frames = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frames);
    if (error == std::errc{} && end == text.data() + text.size() && frames > 0) return frames;
    return Error{ErrorCode::usage, fmt::format("'{}' is neither auto nor none nor a number of frames above 0", text)};
}

class Encode : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("INPUT", source_.path, "a file, a sequence such as walk.####.obj, or -")->required();
        app.add_option("OUTPUT", target_.path, "a .reel file, or -")->required();
        declare_format(app, "--format", source_.format, "the input's format, where its name does not say it");
        source_.declare(app);
        app.get_option("--base")->description("send no connectivity and no order: the reader has this mesh too");
        declare_quality(app);
        declare_coding(app);
        target_.declare_overwriting(app);
        app.footer(
            "A quality is met, and verified by decoding, before the file appears; exit 7 where none meets it.\n\n"
            "Examples:\n"
            "  meshreel encode walk.glb walk.reel\n"
            "  meshreel encode motion.pc2 --mesh mesh.obj out.reel --max-error 0.1%\n"
            "  meshreel encode motion.pc2 --mesh mesh.obj --base mesh.obj out.reel --kg 0.1\n"
            "  meshreel encode motion.pc2 --mesh mesh.obj exact.reel --lossless\n"
            "  meshreel encode walk.####.obj --fps 30 --frames 0:99 walk.reel --bases 40 --step 0.0001\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        target_.format = "reel";
        MESHREEL_TRY(const Go go, prepare(target_, {source_.path, source_.mesh, source_.base}, console));
        Json figures{{"schema", "meshreel.encode/1"}, {"input", source_.path}, {"output", target_.path}};
        figures["skipped"] = go == Go::skip;
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const Animation base, load_base(source_, console));
        MESHREEL_TRY(const std::unique_ptr<FrameSource> frames, open(source_, console));
        const Stopwatch encoding;
        MESHREEL_TRY(const Reached reached,
                     in_file(save_encoded(*frames, options(base, console), target_), source_.path));
        const double encode_seconds = encoding.seconds(), processor_seconds = encoding.processor_seconds();
        MESHREEL_CHECK(add_figures(figures, *frames, reached));
        figures["encode_seconds"] = encode_seconds;
        figures["encode_processor_seconds"] = processor_seconds;
        figures["seconds"] = watch.seconds();
        figures["peak_memory_bytes"] = peak_memory_bytes();
        return Report{figures, summary(figures, frames->still())};
    }

private:
    void declare_quality(CLI::App& app)
    {
        auto* const error =
            add_parsed(app, {"--max-error", "no vertex is ever farther off: percent of the body diagonal, or units"},
                       max_error_, parse_amount);
        error->type_name("X%|X")->group(quality_group);
        std::vector<CLI::Option*> targets = {error};
        const auto target = [&](const char* name, std::optional<double>& value, const char* help) {
            targets.push_back(app.add_option(name, value, help)->check(positive())->type_name("X"));
        };
        target("--kg", quality_.kg, "KG error of at most this many percent");
        target("--sted", quality_.sted, "STED of at most this");
        target("--psnr", quality_.psnr, "PSNR of at least so many dB");
        target("--bpfv", quality_.bpfv, "as good as so many bits a frame and vertex allow");
        targets.push_back(
            add_parsed(app, {"--size", "as good as a file of so many bytes allows: 500k, 2M"}, size_, parse_memory)
                ->type_name("SIZE"));
        const std::vector<CLI::Option*> by_hand = {
            app.add_option("--bases", quality_.bases, "eigentrajectories, by hand")->check(positive())->type_name("K"),
            app.add_option("--step", quality_.step, "coefficient step, by hand: fraction of the body diagonal")
                ->check(positive())
                ->type_name("X")};
        for (std::size_t i = 0; i < targets.size(); ++i) {
            targets[i]->group(quality_group);
            for (std::size_t j = 0; j < i; ++j) targets[i]->excludes(targets[j]);
            for (CLI::Option* hand : by_hand) targets[i]->excludes(hand);
        }
        for (CLI::Option* hand : by_hand) hand->group(quality_group);
        auto* const lossless = app.add_flag_callback(
            "--lossless", [this] { choices_.codec = "lossless"; }, "every float32 bit for bit");
        lossless->group(quality_group);
        for (CLI::Option* other : targets) lossless->excludes(other);
        for (CLI::Option* other : by_hand) lossless->excludes(other);
        app.add_option("--tune", choices_.tune, "what to look best by; default: what the target measures, else kg")
            ->check(one_of({"kg", "sted"}))
            ->type_name("kg|sted")
            ->excludes(lossless)
            ->group(quality_group);
    }

    void declare_coding(CLI::App& app)
    {
        const auto choice = [&](const char* name, std::string& value, std::vector<std::string> words,
                                const char* help) {
            app.add_option(name, value, help)
                ->check(one_of(words))
                ->capture_default_str()
                ->type_name(fmt::format("{}", fmt::join(words, "|")))
                ->group(coding_group);
        };
        choice("--order", choices_.order, {"keep", "free"},
               "vertex and triangle order: kept, or dropped for a smaller file");
        app.add_option("-e,--effort", effort_, "1 encodes fastest, 9 makes the smallest file")
            ->check(CLI::Range(tune::least_effort, tune::most_effort))
            ->capture_default_str()
            ->type_name("1..9")
            ->group(coding_group);
        app.add_flag("--fast-decode", fast_decode_, "opens faster, some percent larger")->group(coding_group);
        choice("--basis", choices_.basis, {basis_coding_names.begin(), basis_coding_names.end()},
               "how the basis is coded");
        choice("--entropy", choices_.entropy, {"huffman", "range"}, "how residuals become bits");
        add_parsed(app, {"--segment", "frames that are coded together at most; auto decides, none never cuts"},
                   segment_, parse_segment)
            ->type_name("auto|N|none")
            ->group(coding_group);
        app.add_option("--codec", choices_.codec, "the codec")
            ->capture_default_str()
            ->type_name("NAME")
            ->excludes("--lossless")
            ->group(coding_group);
    }

    EncodeOptions options(const Animation& base, Console& console) const
    {
        EncodeOptions all;
        all.codec = choices_.codec;
        all.quality = quality_;
        if (size_ > 0) all.quality.size = size_;
        if (max_error_.value > 0.0)
            (max_error_.percent ? all.quality.max_error_relative : all.quality.max_error) = max_error_.value;
        all.tune = choices_.tune_value();
        all.effort = effort_;
        all.fast_decode = fast_decode_;
        all.order = choices_.order_value(!source_.base.empty());
        all.base = source_.base.empty() ? nullptr : &base;
        all.basis = choices_.basis_value();
        all.entropy = choices_.entropy_value();
        all.segment = segment_;
        all.threads = source_.threads;
        all.progress = console.progress();
        return all;
    }

    Status add_figures(Json& figures, FrameSource& frames, const Reached& reached) const
    {
        const Animation& animation = frames.still();
        Matrix<float> room;
        MESHREEL_TRY(const MatrixView<const float> first, frames.frames(0, 1, room));
        const double diagonal = body_diagonal(first.row(0));
        add_counts(figures, animation);
        figures["codec"] = choices_.codec;
        figures["order"] = source_.base.empty() ? choices_.order : "base";
        figures["basis"] = choices_.basis;
        figures["entropy"] = choices_.entropy;
        figures["raw_bytes"] = raw_bytes(animation);
        figures["reel_bytes"] = reached.file_bytes;
        figures["bpfv"] = number(reached.bpfv);
        figures["kg"] = number(reached.kg);
        figures["max_error"] = number(reached.max_error);
        figures["max_error_relative"] = number(diagonal > 0.0 ? 100.0 * reached.max_error / diagonal : 0.0);
        figures["psnr"] = number(reached.psnr);
        figures["sted"] = reached.sted ? number(*reached.sted) : Json(nullptr);
        figures["effort"] = effort_;
        figures["bases"] = reached.bases;
        figures["step"] = number(reached.step);
        return Ok{};
    }

    std::string summary(const Json& figures, const Animation& animation) const
    {
        const auto value = [&](const char* name) {
            return figures[name].is_null() ? 0.0 : figures[name].get<double>();
        };
        std::string text = fmt::format("{} -> {}: {}\n", source_.path, target_.path, counts_text(animation));
        text += fmt::format("  {} -> {}, {:.4g} bits a frame and vertex\n", human_bytes(value("raw_bytes")),
                            human_bytes(value("reel_bytes")), value("bpfv"));
        text += fmt::format("  KG error {:.4g} %, largest error {:.4g} units = {:.4g} % of the diagonal\n", value("kg"),
                            value("max_error"), value("max_error_relative"));
        text += figures["psnr"].is_null() ? "  nothing lost" : fmt::format("  PSNR {:.4g} dB", value("psnr"));
        text += figures["sted"].is_null() ? "\n" : fmt::format(", STED {:.4g}\n", value("sted"));
        return text + fmt::format("  {} bases, step {:.4g}; {:.2f} s, at most {} of memory\n", value("bases"),
                                  value("step"), value("seconds"), human_bytes(value("peak_memory_bytes")));
    }

    Source source_;
    Target target_;
    Amount max_error_;
    Quality quality_;
    std::uint64_t size_ = 0;
    int effort_ = tune::usual_effort;
    bool fast_decode_ = false;
    std::uint32_t segment_ = 0;
    Choices choices_;
};

} // namespace

std::unique_ptr<Verb> make_encode()
{
    return std::make_unique<Encode>();
}

} // namespace meshreel::cli
