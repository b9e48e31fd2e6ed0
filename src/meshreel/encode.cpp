/// The way into a file: weld, trace, search for the quality asked for, assemble, decode again and measure.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "meshreel/base/memory.h"
#include "meshreel/base/text.h"
#include "meshreel/codecs/choice.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/container/package.h"
#include "meshreel/goal.h"
#include "meshreel/likely_step.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/weld.h"
#include "meshreel/meshreel.h"
#include "meshreel/prepared_segments.h"
#include "meshreel/tune/meter.h"
#include "meshreel/tune/search.h"
#include "meshreel/verification.h"
#include "meshreel/version.h"

namespace meshreel {

namespace {

/// How a file is made that opens fast: see docs/effort.md.
struct FastWay {
    std::uint32_t growth, neighbours;
};
constexpr std::array<FastWay, 5> fast_ways{{{24, 10}, {12, 10}, {8, 12}, {4, 14}, {4, 16}}}; // the fastest first
constexpr double most_for_fast = 1.09;   // what one may cost at the same step
constexpr double nearly_missed = 0.99;   // of the largest error allowed
constexpr std::size_t usual_bases = 256; // enough for nearly every target; more are prepared when it is not

Error usage(std::string message)
{
    return {ErrorCode::usage, std::move(message), {}, {}, {}};
}

/// Payloads for Encoding::assemble().
auto from(const std::vector<Bytes>& payloads)
{
    return [&payloads](std::size_t s) { return Result<ByteView>(payloads[s]); };
}

/// An animation on its way into a file.
class Encoding {
public:
    /// Reads the frames twice and a first time segment by segment. @fails as the source does.
    static Result<std::unique_ptr<Encoding>> begin(FrameSource& source, const EncodeOptions& options,
                                                   const codecs::Codec& codec)
    {
        const Animation& still = source.still();
        MESHREEL_TRY(const Weld welded, weld(source, WeldOptions{options.threads}));
        std::unique_ptr<Encoding> encoding(
            new Encoding(source, options, codec,
                         connectivity::encode({still.vertex_count, still.triangles, welded.unique_of}, options.order)));
        MESHREEL_CHECK(encoding->look());
        return encoding;
    }

    /// The smallest file found that keeps the quality asked for, or the best one of the size asked for.
    Result<Reached> encode(Spool& spool)
    {
        if (codec_.exact()) return exact(spool);
        if (options_.quality.bases || options_.quality.step) {
            MESHREEL_TRY(const codecs::Settings settings, by_hand());
            MESHREEL_TRY(const tune::Attempt attempt, attempted(settings));
            return finished(attempt, spool);
        }
        MESHREEL_TRY(const Encoded best, searched());
        MESHREEL_CHECK(spool.write(best.bytes));
        return best;
    }

private:
    const connectivity::Surface& surface() const { return topology_.topology.surface; }

    Encoding(FrameSource& source, const EncodeOptions& options, const codecs::Codec& codec,
             connectivity::Encoded topology)
        : source_(source), options_(options), codec_(codec), topology_(std::move(topology)),
          segments_({source, topology_, codec, options.threads})
    {
    }

    Result<Encoded> searched()
    {
        std::optional<Encoded> best;
        MESHREEL_TRY(const double spread, length_spread());
        tune::Problem problem{
            [&](const codecs::Settings& settings) { return attempted(settings); },
            [&](const tune::Attempt& attempt) { return verified(attempt, best); },
            !limits_size(),
            plan_.knobs,
            plan_.rounds,
            spread,
            plan_.telling,
            options_.progress,
            [&](tune::Attempt attempt) { return mended(std::move(attempt)); },
        };
        codecs::Settings start = common(plan_.start);
        if (limits_distance()) {
            spare_no_vertex(start);
            // its gain is below what the largest error varies by chance
            std::erase_if(problem.knobs,
                          [](const tune::Knob& knob) { return knob.setting == &codecs::Settings::linear; });
        }
        start.step = likely_step(figures(segments_.spectra()), allowed_, start);
        MESHREEL_TRY(start, opening_fast(start));
        const Result<tune::Attempt> found = tune::cheapest(problem, start);
        if (!found.ok())
            return found.error().code == ErrorCode::missed && found.error().field.empty() ? missed() : found.error();
        return *std::move(best);
    }

    const Animation& still() const { return source_.still(); }
    double points() const { return static_cast<double>(source_.frame_count()) * surface().vertex_count; }

    /// What must be known of the motion before anything is tried.
    Status look()
    {
        Matrix<float> room;
        MESHREEL_TRY(const MatrixView<const float> first, source_.frames(0, 1, room));
        const double length = body_diagonal(first.row(0));
        diagonal_ = length > 0 ? length : 1.0;
        std::vector<float> coded(3ul * surface().vertex_count);
        reorder_frame(first.row(0), topology_.original_of, coded);
        mean_edge_ = tune::mean_edge(coded, surface().triangles);
        allowed_ = allowed_by(options_.quality, still(), diagonal());
        plan_ = tune::plan_of(options_.effort, tune());
        MESHREEL_CHECK(cut());
        MESHREEL_CHECK(segments_.prepare(usual_bases));
        MESHREEL_CHECK(divide());
        if (std::isfinite(allowed_.kg) && norm() == 0) // every frame a point: nothing that KG could be a percentage of
            allowed_.max_error = std::exchange(allowed_.kg, no_limit) / 100 * diagonal();
        return Ok{};
    }

    /// As asked for, or where it pays.
    Status cut()
    {
        const std::size_t F = source_.frame_count(), longest = longest_segment(surface().vertex_count, codec_.exact());
        segments_.cut(equal_segments(F, options_.segment == 0 ? longest : options_.segment));
        const bool no_step = options_.quality.bases && !options_.quality.step;
        if (options_.segment != 0 || codec_.exact() || no_step) return Ok{};
        MESHREEL_TRY(const SegmentSample sample, SegmentSample::take(source_, topology_.original_of));
        const codecs::Settings likely = likely_settings(std::array{sample.spectrum(0, F)});
        const SegmentCosts costs(sample, {likely.step, likely.basis_ratio});
        segments_.cut(paying_segments(F, longest, costs));
        return Ok{};
    }

    /// Divides segments whose components are too many to be held beside long ones.
    Status divide()
    {
        const std::size_t fits = longest_rich_segment(surface().vertex_count);
        if (options_.segment != 0 || codec_.exact() || segments_.longest() <= fits) return Ok{};
        const codecs::Settings likely = likely_settings(segments_.spectra());
        const bool rich = std::ranges::any_of(segments_.spectra(), [&](const Spectrum& spectrum) {
            return codecs::bases_of(likely, spectrum.singular_values, surface().vertex_count) >= usual_bases;
        });
        if (!rich) return Ok{};
        segments_.cut(divided(segments_.spans(), fits));
        return segments_.prepare(usual_bases);
    }

    codecs::Settings likely_settings(std::span<const Spectrum> spectra) const
    {
        codecs::Settings settings = common(plan_.start);
        settings.bases = options_.quality.bases;
        settings.step = options_.quality.step ? *options_.quality.step * diagonal()
                                              : likely_step(figures(spectra), allowed_, settings);
        return settings;
    }

    /// |A - E(A)| of (5.2), over the vertices that the codec sees.
    double norm() const { return norm_of(segments_.spectra()); }

    MotionFigures figures(std::span<const Spectrum> spectra) const
    {
        return {surface().vertex_count, diagonal(), mean_edge_, spectra};
    }

    double diagonal() const { return diagonal_; }

    Tune tune() const
    {
        const bool sees = options_.quality.sted || (std::isfinite(allowed_.sted) && !options_.quality.kg);
        return options_.tune.value_or(sees ? Tune::sted : Tune::kg);
    }

    bool limits_distance() const { return options_.quality.max_error || options_.quality.max_error_relative; }
    /// Whether frames may be drawn towards lengths of edges: not where a vertex could be drawn beyond a limit.
    bool relaxes() const
    {
        return codec_.detail != nullptr && !plan_.knobs.empty() && !surface().triangles.empty() && !limits_distance() &&
               !options_.fast_decode;
    }

    /// How far lengths of edges vary in the first segment; infinite where nothing is relaxed.
    Result<double> length_spread()
    {
        constexpr std::size_t enough_frames = 64; // fewer tell too little of what lengths are
        if (!relaxes() || source_.frame_count() < enough_frames) return std::numeric_limits<double>::infinity();
        MESHREEL_TRY(const PreparedSegments::Visit segment, segments_.visit(0));
        return tune::Meter(segment.frames, surface().triangles, options_.threads).length_spread();
    }

    bool limits_size() const { return std::isfinite(allowed_.bytes); }
    bool wants_sted() const { return std::isfinite(allowed_.sted) || (limits_size() && tune() == Tune::sted); }

    /// For a limit on the largest error: whatever component is left out or level made cheap, some vertex misses it.
    static void spare_no_vertex(codecs::Settings& settings)
    {
        settings.truncation = 0.08;
        settings.bit_price = 0.0;
        settings.taper = 0.0;
    }

    codecs::Settings common(codecs::Settings settings) const
    {
        settings.basis = options_.basis;
        settings.entropy = options_.entropy;
        settings.threads = options_.threads;
        return settings;
    }

    /// The fastest way that does not cost too much, if the file is to open fast.
    Result<codecs::Settings> opening_fast(codecs::Settings settings)
    {
        if (!options_.fast_decode) return settings;
        MESHREEL_TRY(const tune::Attempt usual, attempted(settings));
        MESHREEL_TRY(const double usual_size, file_size(usual.payloads));
        settings.mixed = false;
        for (const FastWay& way : fast_ways) {
            settings.growth = std::max(plan_.start.growth, way.growth);
            settings.neighbours = way.neighbours;
            MESHREEL_TRY(const tune::Attempt attempt, attempted(settings));
            MESHREEL_TRY(const double size, file_size(attempt.payloads));
            if (size <= most_for_fast * usual_size) break;
        }
        return settings;
    }

    Result<codecs::Settings> by_hand()
    {
        codecs::Settings settings = common({.growth = plan_.start.growth}); // nothing is tuned
        settings.bases = options_.quality.bases;
        settings.step = options_.quality.step.value_or(0.0) * diagonal();
        if (settings.bases && *settings.bases > segments_.max_bases())
            MESHREEL_CHECK(segments_.prepare(*settings.bases));
        return opening_fast(settings);
    }

    /// The file of a codec that loses nothing, segment by segment.
    Result<Reached> exact(Spool& spool)
    {
        tune::Attempt attempt;
        MESHREEL_CHECK(assemble(spool, [&](std::size_t s) -> Result<Bytes> {
            MESHREEL_TRY(const PreparedSegments::Visit segment, segments_.visit(s));
            codecs::Trial trial = segment.encoder.encode(common({.growth = plan_.start.growth}));
            note(trial, attempt);
            return std::move(trial.payload);
        }));
        return measured(spool, attempt);
    }

    static void note(const codecs::Trial& trial, tune::Attempt& attempt)
    {
        attempt.bases = std::max(attempt.bases, trial.bases);
        attempt.step = std::max(attempt.step, trial.step);
    }

    /// A vertex that is too far off in one frame is coded anew, aimed beyond where it should be: a few that miss the limit
    /// need no finer step for all.
    Result<tune::Attempt> mended(tune::Attempt attempt)
    {
        constexpr int most_trials = 4;
        Nudges nudges;
        for (int i = 0; i < most_trials && attempt.excess > 1.0 && !attempt.nudges.empty(); ++i) {
            nudges.resize(attempt.nudges.size());
            for (std::size_t s = 0; s < nudges.size(); ++s)
                nudges[s].insert(nudges[s].end(), attempt.nudges[s].begin(), attempt.nudges[s].end());
            MESHREEL_TRY(attempt, attempted(attempt.settings, nudges));
        }
        return attempt;
    }

    using Nudges = std::vector<std::vector<codecs::Nudge>>; ///< of each segment

    /// Encodes all segments and measures what the decoder will see, nearly: in surface order, before rounding.
    Result<tune::Attempt> attempted(codecs::Settings settings, const Nudges& nudges = {})
    {
        settings.step = std::max(settings.step, settings.step > 0 ? finest_step() : 0.0);
        tune::Attempt attempt;
        attempt.settings = settings;
        double squared_error = 0, sted = 0;
        Measures reached;
        for (std::size_t s = 0; s < segments_.count(); ++s) {
            MESHREEL_TRY(const PreparedSegments::Visit segment, segments_.visit(s));
            settings.nudges = s < nudges.size() ? nudges[s] : std::vector<codecs::Nudge>();
            codecs::Trial trial = segment.encoder.encode(settings);
            if (trial.bases == segments_.max_bases() && !settings.bases && segments_.max_bases() < most_bases()) {
                trial = {}; // it holds as much as the frames do
                MESHREEL_CHECK(segments_.prepare(std::min(4 * segments_.max_bases(), most_bases())));
                return attempted(settings, nudges);
            }
            squared_error += trial.squared_error;
            const tune::Meter meter(segment.frames, surface().triangles, options_.threads);
            if (std::isfinite(allowed_.max_error)) {
                tune::Meter::Distances off = meter.distances(trial.decoded, nearly_missed * allowed_.max_error);
                reached.max_error = std::max(reached.max_error, off.largest);
                attempt.nudges.push_back(std::move(off.nudges));
            }
            if (wants_sted()) sted += static_cast<double>(segment.frames.rows) * meter.sted(trial.decoded);
            note(trial, attempt);
            attempt.payloads.push_back(std::move(trial.payload));
        }
        reached.kg = norm() > 0 ? 100 * std::sqrt(squared_error) / norm() : 0.0; // (5.2)
        attempt.mean_square = squared_error / points();
        reached.rms = std::sqrt(attempt.mean_square);
        reached.sted = sted / static_cast<double>(source_.frame_count());
        MESHREEL_TRY(reached.bytes, file_size(attempt.payloads));
        attempt.excess = excess_of(reached, allowed_);
        attempt.cost = !limits_size() ? reached.bytes : tune() == Tune::sted ? reached.sted : reached.rms;
        return attempt;
    }

    /// Of the file that these payloads make.
    Result<double> file_size(const std::vector<Bytes>& payloads)
    {
        double size = 0;
        for (const Bytes& payload : payloads) size += static_cast<double>(payload.size());
        if (!around_) {
            MemorySpool file;
            MESHREEL_CHECK(assemble(file, from(payloads)));
            around_ = static_cast<double>(file.size()) - size;
        }
        return *around_ + size;
    }

    /// The excess of the decoded file. Keeps the file where it is the best one yet.
    Result<double> verified(const tune::Attempt& attempt, std::optional<Encoded>& best)
    {
        MemorySpool file;
        MESHREEL_TRY(const Reached reached, finished(attempt, file));
        const double excess = excess_of(measures_of(reached), allowed_);
        if (excess <= 1.0 && (!best || excess > excess_of(measures_of(*best), allowed_)))
            best = Encoded{reached, std::move(file).take()};
        return excess;
    }

    Measures measures_of(const Reached& reached) const
    {
        return {reached.kg, diagonal() * std::pow(10.0, -reached.psnr / 20), reached.max_error,
                reached.sted.value_or(0.0), static_cast<double>(reached.file_bytes)};
    }

    Error missed() const
    {
        return {ErrorCode::missed,
                limits_size()
                    ? concat("no setting of the codec fits into ", static_cast<std::uint64_t>(allowed_.bytes),
                             " bytes, of which ", static_cast<std::uint64_t>(around_.value_or(0.0)), " are not motion")
                    : "no setting of the codec keeps the quality asked for",
                {},
                {},
                {}};
    }

    std::size_t most_bases() const { return std::min<std::size_t>(3 * segments_.longest(), surface().vertex_count); }

    /// Below it levels would saturate, and float32 could not tell the difference.
    double finest_step() const
    {
        const double largest_coefficient = diagonal() * std::sqrt(static_cast<double>(source_.frame_count()));
        return largest_coefficient / coding::Quantiser::largest_level;
    }

    /// payload_of(s): of segment s, asked for in their order; bytes, or a view of them.
    template <class PayloadOf>
    Status assemble(Spool& spool, const PayloadOf& payload_of) const
    {
        container::Header header;
        header.codec = codec_.name;
        header.vertex_count = still().vertex_count;
        header.coded_vertex_count = surface().vertex_count;
        header.triangle_count = static_cast<std::uint32_t>(still().triangles.size());
        header.frame_count = static_cast<std::uint32_t>(source_.frame_count());
        header.order = options_.order;
        if (options_.order == Order::base)
            header.base_fingerprint = container::fingerprint_of(still().vertex_count, still().triangles);
        header.encoder = concat("meshreel ", version);
        container::StreamWriter file(spool);
        MESHREEL_CHECK(container::add_head(file, header, still().times_s, still().meta));
        file.add(container::type::conn, ByteView(topology_.bytes));
        const bool renumbered = options_.order == Order::free;
        const Appearance& appearance = still().appearance;
        MESHREEL_CHECK(container::add_appearance(
            file, renumbered ? reordered(appearance, {topology_.vertex_of, topology_.corner_of}) : appearance,
            {still().vertex_count, topology_.topology.triangles}));
        for (std::size_t s = 0; s < segments_.count(); ++s) {
            const auto [first, count] = segments_.span(s);
            MESHREEL_TRY(const auto payload, payload_of(s));
            MESHREEL_CHECK(
                file.add(container::type::segm, container::Segment{static_cast<std::uint32_t>(first),
                                                                   static_cast<std::uint32_t>(count), payload}));
        }
        return file.finish();
    }

    /// The file of an attempt.
    Result<Reached> finished(const tune::Attempt& attempt, Spool& spool)
    {
        MESHREEL_CHECK(assemble(spool, from(attempt.payloads)));
        return measured(spool, attempt);
    }

    /// The file decoded again and measured in the original order.
    Result<Reached> measured(Spool& file, const tune::Attempt& attempt)
    {
        MESHREEL_TRY(const Difference off,
                     difference(file, source_, {topology_.vertex_of, options_.base, wants_sted(), options_.threads}));
        Reached reached;
        reached.file_bytes = file.size();
        reached.bpfv = 8.0 * static_cast<double>(file.size()) /
                       (static_cast<double>(source_.frame_count()) * still().vertex_count); // (9.1)
        reached.kg = off.kg;
        reached.max_error = std::sqrt(off.vertex_error.largest_square);
        reached.psnr = 10 * std::log10(diagonal() * diagonal() / off.vertex_error.mean_square); // (5.1)
        reached.sted = off.sted;
        reached.bases = attempt.bases;
        reached.step = attempt.step / diagonal();
        return reached;
    }

    FrameSource& source_;
    const EncodeOptions& options_;
    const codecs::Codec& codec_;
    connectivity::Encoded topology_;
    PreparedSegments segments_;
    double diagonal_ = 1.0, mean_edge_ = 0.0; ///< of the first frame
    std::optional<double> around_;            ///< bytes of a file that are not payload
    Measures allowed_;
    tune::Plan plan_;
};

} // namespace

Result<Encoded> encode(const Animation& animation, const EncodeOptions& options)
{
    return within_memory([&]() -> Result<Encoded> {
        MESHREEL_CHECK(validate(animation));
        HeldFrames frames(animation);
        return encode(frames, options);
    });
}

Result<Encoded> encode(FrameSource& frames, const EncodeOptions& options)
{
    return within_memory([&]() -> Result<Encoded> {
        MemorySpool file;
        MESHREEL_TRY(const Reached reached, encode(frames, file, options));
        return Encoded{reached, std::move(file).take()};
    });
}

Result<Reached> encode(FrameSource& frames, Spool& spool, const EncodeOptions& options)
{
    return within_memory([&]() -> Result<Reached> {
        MESHREEL_CHECK(validate_still(frames.still()));
        MESHREEL_CHECK(check_options(frames.still(), options));
        const codecs::Codec* codec = codecs::find(options.codec);
        if (codec == nullptr) return usage(concat("there is no codec \"", options.codec, "\""));
        if (codec->exact() && asks_anything(options.quality))
            return usage(concat("the codec ", options.codec, " loses nothing: it has no quality to choose"));
        MESHREEL_TRY(const std::unique_ptr<Encoding> encoding, Encoding::begin(frames, options, *codec));
        return encoding->encode(spool);
    });
}

} // namespace meshreel
