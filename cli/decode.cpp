/// decode: rebuilds an animation from a .reel file and writes it in any format.
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/numbers.h"
#include "cli/reel_file.h"
#include "cli/source.h"
#include "cli/target.h"
#include "cli/verb.h"
#include "meshreel/base/file.h"
#include "meshreel/container/package.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

class Decode : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("INPUT", source_.path, "a .reel file, or -")->required();
        app.add_option("OUTPUT", target_.path, "a file, a sequence such as back.####.obj, or -")->required();
        declare_format(app, "--format", target_.format, "the output's format, where its name does not say it");
        app.add_option("--base", source_.base, "the base mesh that the file was made with")->type_name("FILE");
        add_parsed(app, {"--frames", "frames to take, from 0, the last included"}, source_.frames, parse_frames)
            ->type_name("A:B:STEP");
        app.add_option("--fps", source_.fps, "frames a second: moves between the stored frames, smoothly")
            ->check(positive())
            ->type_name("N");
        app.add_option("--level", source_.level, "level of detail: 0 is everything, each further one about a quarter")
            ->type_name("N");
        source_.declare_limits(app);
        target_.declare(app);
        app.footer("Examples:\n"
                   "  meshreel decode walk.reel walk.####.obj\n"
                   "  meshreel decode out.reel back.pc2 --mesh-out mesh.obj\n"
                   "  meshreel decode out.reel back.mdd --base mesh.obj\n"
                   "  meshreel decode walk.reel walk.glb --morphs pca\n"
                   "  meshreel decode walk.reel smooth.####.obj --fps 60 --frames 100:149\n"
                   "  meshreel decode walk.reel far_away.glb --level 2\n");
    }

    Result<Report> run(Console& console) override
    {
        const Stopwatch watch;
        source_.format = "reel";
        MESHREEL_TRY(const Go go, prepare(target_, {source_.path, source_.base}, console));
        Json figures{{"schema", "meshreel.decode/1"}, {"input", source_.path}, {"output", target_.path}};
        figures["skipped"] = go == Go::skip;
        if (go == Go::skip) return Report{figures, fmt::format("{}: exists, skipped\n", target_.path)};
        MESHREEL_TRY(const bool long_one, is_long());
        if (long_one) return stream(figures, watch, console);
        const Stopwatch decoding;
        MESHREEL_TRY(const Animation animation, load(source_, console));
        const double decode_seconds = decoding.seconds(), processor_seconds = decoding.processor_seconds();
        const unsigned long long decode_memory = peak_memory_bytes();
        MESHREEL_CHECK(save(animation, target_, console));
        add_counts(figures, animation);
        figures["raw_bytes"] = raw_bytes(animation);
        figures["decode_seconds"] = decode_seconds;
        figures["decode_processor_seconds"] = processor_seconds;
        figures["decode_peak_memory_bytes"] = decode_memory;
        figures["seconds"] = watch.seconds();
        figures["peak_memory_bytes"] = peak_memory_bytes();
        return Report{figures, fmt::format("{} -> {}: {}\n  {:.2f} s, at most {} of memory\n", source_.path,
                                           target_.path, counts_text(animation), watch.seconds(),
                                           human_bytes(static_cast<double>(peak_memory_bytes())))};
    }

private:
    bool takes_all() const
    {
        const io::FrameRange all;
        return source_.fps == 0.0 && source_.level == 0 && source_.frames.first == all.first &&
               source_.frames.last == all.last && source_.frames.step == all.step;
    }

    DecodeOptions options(const Animation& base, Console& console) const
    {
        DecodeOptions options;
        options.base = source_.base.empty() ? nullptr : &base;
        options.limits = source_.limits;
        options.threads = source_.threads;
        options.progress = console.progress();
        return options;
    }

    /// Whether the positions are better not held all at once, and need not be.
    Result<bool> is_long() const
    {
        constexpr std::uint64_t held_bytes = 256 << 20;
        if (!takes_all() || !takes_frames(target_) || !is_regular_file(source_.path)) return false;
        MESHREEL_TRY(FileSource file, FileSource::open(source_.path));
        MESHREEL_TRY(const auto head, in_file(container::StreamReader::open_head(file, source_.limits), source_.path));
        MESHREEL_TRY(const container::Header header, in_file(container::read_header(head), source_.path));
        return 12 * std::uint64_t{header.vertex_count} * header.frame_count > held_bytes;
    }

    /// Decodes a segment, writes its frames, and so on.
    Result<Report> stream(Json& figures, const Stopwatch& watch, Console& console)
    {
        MESHREEL_TRY(const Animation base, load_base(source_, console));
        MESHREEL_TRY(FileSource file, FileSource::open(source_.path));
        MESHREEL_TRY(const std::unique_ptr<FrameSource> frames,
                     in_file(open_frames(file, options(base, console)), source_.path));
        MESHREEL_CHECK(save(*frames, target_, console));
        add_counts(figures, frames->still());
        figures["raw_bytes"] = raw_bytes(frames->still());
        figures["decode_seconds"] = watch.seconds(); // what is written meanwhile included
        figures["decode_processor_seconds"] = watch.processor_seconds();
        figures["decode_peak_memory_bytes"] = peak_memory_bytes();
        figures["seconds"] = watch.seconds();
        figures["peak_memory_bytes"] = peak_memory_bytes();
        return Report{figures, fmt::format("{} -> {}: {}\n  {:.2f} s, at most {} of memory\n", source_.path,
                                           target_.path, counts_text(frames->still()), watch.seconds(),
                                           human_bytes(static_cast<double>(peak_memory_bytes())))};
    }

    Source source_;
    Target target_;
};

} // namespace

std::unique_ptr<Verb> make_decode()
{
    return std::make_unique<Decode>();
}

} // namespace meshreel::cli
