/// The way into a file: weld, trace, search for the quality asked for, assemble, decode again and measure.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>

#include "meshreel/base/text.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/container/package.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/weld.h"
#include "meshreel/meshreel.h"
#include "meshreel/metrics/kg.h"
#include "meshreel/metrics/vertex_error.h"
#include "meshreel/tune/search.h"
#include "meshreel/version.h"

namespace meshreel {

namespace {

constexpr std::size_t usual_segment = 1000; // frames at most; the PCA grows with the cube of a segment's length
constexpr std::size_t usual_bases = 256;    // enough for nearly every target; more are prepared when it is not

Error usage(std::string message)
{
    return {ErrorCode::usage, std::move(message), {}, {}, {}};
}

struct FrameSpan {
    std::size_t first, count;
};

/// As few segments as the longest allows, of nearly equal length.
std::vector<FrameSpan> segments_of(std::size_t F, std::size_t longest)
{
    const std::size_t count = F / longest + (F % longest != 0);
    std::vector<FrameSpan> segments;
    for (std::size_t s = 0; s < count; ++s) segments.push_back({F * s / count, F * (s + 1) / count - F * s / count});
    return segments;
}

/// An animation on its way into a file.
class Encoding {
public:
    Encoding(const Animation& animation, const EncodeOptions& options, const codecs::Codec& codec)
        : animation_(animation), options_(options), codec_(codec),
          topology_(connectivity::encode(
              {animation.vertex_count, animation.triangles, weld(animation, options.threads).unique_of},
              options.order)),
          segments_(segments_of(animation.frame_count(), options.segment == 0 ? usual_segment : options.segment))
    {
        const std::size_t W = surface().vertex_count;
        frames_ = Matrix<float>(animation.frame_count(), 3 * W);
        for (std::size_t f = 0; f < frames_.rows; ++f)
            reorder_frame(animation.frame(f), topology_.original_of, frames_.row(f));
        prepare(usual_bases);
    }

    /// The smallest file found that keeps the quality asked for.
    Result<Encoded> encode()
    {
        const Quality& quality = options_.quality;
        if (quality.bases || quality.step) {
            try_settings(by_hand());
            return finished();
        }
        by_kg_ = quality.kg && norm() > 0;
        target_ = by_kg_ ? *quality.kg : largest_allowed();
        MESHREEL_TRY(codecs::Settings settings, found());
        // The search measures in surface order and before rounding; what counts is measured on the file. Where the two
        // differ, the step aims anew.
        double aim = target_;
        for (int turn = 0; turn < 6; ++turn) {
            MESHREEL_TRY(const auto best, tune::coarsest(problem(aim, false), settings));
            if (!best) break;
            settings = best->settings;
            try_settings(settings);
            MESHREEL_TRY(Encoded encoded, finished());
            const double reached = by_kg_ ? encoded.kg : encoded.max_error;
            if (reached <= target_) return encoded;
            aim *= 0.998 * target_ / reached;
        }
        return Error{ErrorCode::missed, concat("the decoded file stays above the target of ", target_), {}, {}, {}};
    }

private:
    const connectivity::Surface& surface() const { return topology_.topology.surface; }

    MatrixView<const float> frames(FrameSpan span) const
    {
        return {frames_.values.data() + span.first * frames_.cols, span.count, frames_.cols};
    }

    void prepare(std::size_t max_bases)
    {
        encoders_.clear();
        for (const FrameSpan& segment : segments_)
            encoders_.push_back(codec_.prepare({surface(), frames(segment)}, max_bases, options_.threads));
        max_bases_ = max_bases;
    }

    /// |A - E(A)| of (5.2), over the vertices that the codec sees.
    double norm() const
    {
        double energy = 0;
        for (const auto& encoder : encoders_) energy += encoder->energy();
        return std::sqrt(energy);
    }

    double diagonal() const
    {
        const double length = body_diagonal(animation_);
        return length > 0 ? length : 1.0;
    }

    double largest_allowed() const
    {
        const Quality& quality = options_.quality;
        constexpr double usual_percent = 0.05;
        if (quality.max_error) return *quality.max_error;
        const double percent = quality.max_error_relative ? *quality.max_error_relative
                               : quality.kg               ? *quality.kg
                                                          : usual_percent;
        return percent / 100 * diagonal();
    }

    codecs::Settings common() const
    {
        codecs::Settings settings;
        settings.basis = options_.basis;
        settings.entropy = options_.entropy;
        settings.threads = options_.threads;
        return settings;
    }

    codecs::Settings by_hand()
    {
        codecs::Settings settings = common();
        settings.bases = options_.quality.bases;
        settings.step = options_.quality.step.value_or(0.0) * diagonal();
        if (settings.bases && *settings.bases > max_bases_) prepare(*settings.bases);
        return settings;
    }

    /// Encodes all segments; keeps the payloads.
    void try_settings(const codecs::Settings& settings)
    {
        payloads_.clear();
        tried_ = {};
        for (const auto& encoder : encoders_) {
            codecs::Trial trial = encoder->encode(settings);
            tried_.squared_error += trial.squared_error;
            tried_.bases = std::max(tried_.bases, trial.bases);
            tried_.step = std::max(tried_.step, trial.step);
            payloads_.push_back(std::move(trial.payload));
        }
    }

    std::uint64_t payload_size() const
    {
        std::uint64_t size = 0;
        for (const Bytes& payload : payloads_) size += payload.size();
        return size;
    }

    /// Decodes the payloads into surface order.
    Result<Matrix<float>> rebuilt() const
    {
        Matrix<float> result(frames_.rows, frames_.cols);
        for (std::size_t s = 0; s < segments_.size(); ++s) {
            const MatrixView<float> part{result.values.data() + segments_[s].first * result.cols, segments_[s].count,
                                         result.cols};
            MESHREEL_CHECK(codecs::decode(
                codec_, {{payloads_[s], 0, "SEGM"}, surface(), segments_[s].count, DecodeLimits{}, options_.threads},
                part));
        }
        return result;
    }

    double kg_of(double squared_error) const { return 100 * std::sqrt(squared_error) / norm(); } // (5.2)

    tune::Attempt estimated(const codecs::Settings& settings) const
    {
        tune::Attempt attempt{settings, 0, 0.0};
        double squared_error = 0;
        attempt.settings.bases = 0;
        for (const auto& encoder : encoders_) {
            const codecs::Estimate estimate = encoder->estimate(settings);
            attempt.size += estimate.size;
            squared_error += estimate.squared_error;
            attempt.settings.bases = std::max(*attempt.settings.bases, estimate.bases);
        }
        attempt.distortion = kg_of(squared_error);
        return attempt;
    }

    Result<tune::Attempt> attempted(const codecs::Settings& settings)
    {
        try_settings(settings);
        tune::Attempt attempt{settings, payload_size(), kg_of(tried_.squared_error)};
        attempt.settings.bases = tried_.bases;
        if (by_kg_) return attempt;
        MESHREEL_TRY(const Matrix<float> decoded, rebuilt());
        attempt.distortion = largest_distance({frames_view(), decoded.view(), {}});
        return attempt;
    }

    /// A search for the KG error goes by estimates if that will do; the largest error needs the decoded positions.
    tune::Problem problem(double target, bool estimates)
    {
        const auto attempt = [this, estimates](const codecs::Settings& settings) -> Result<tune::Attempt> {
            return estimates && by_kg_ ? Result<tune::Attempt>(estimated(settings)) : attempted(settings);
        };
        if (by_kg_) return {attempt, target, {0.65}, true, options_.progress};
        return {attempt, target, {0.65, 0.3, 0.15, 0.07, 0.03}, false, options_.progress};
    }

    MatrixView<const float> frames_view() const { return frames_.view(); }

    double largest_distance(const metrics::Pair<float>& pair) const
    {
        return std::sqrt(metrics::vertex_error(pair, options_.threads).largest_square);
    }

    /// The settings of the smallest file, nearly; with more bases prepared where the usual ones are too few.
    Result<codecs::Settings> found()
    {
        codecs::Settings start = common();
        const double typical = norm() / std::sqrt(static_cast<double>(frames_.values.size()));
        start.step = by_kg_ ? target_ / 100 * typical * 6 : target_;
        Result<tune::Attempt> best = tune::smallest(problem(target_, true), start);
        const std::size_t all_bases = std::min<std::size_t>(3 * segments_.back().count, surface().vertex_count);
        if (!best.ok() && best.error().code == ErrorCode::missed && max_bases_ < all_bases) {
            prepare(all_bases);
            best = tune::smallest(problem(target_, true), start);
        }
        MESHREEL_TRY(const tune::Attempt attempt, std::move(best));
        return attempt.settings;
    }

    Result<Bytes> assembled() const
    {
        container::Header header;
        header.codec = codec_.name;
        header.vertex_count = animation_.vertex_count;
        header.coded_vertex_count = surface().vertex_count;
        header.triangle_count = static_cast<std::uint32_t>(animation_.triangles.size());
        header.frame_count = static_cast<std::uint32_t>(animation_.frame_count());
        header.order = options_.order;
        if (options_.order == Order::base)
            header.base_fingerprint = container::fingerprint_of(animation_.vertex_count, animation_.triangles);
        header.encoder = concat("meshreel ", version);
        container::StreamWriter file;
        MESHREEL_CHECK(container::add_head(file, header, animation_.times_s, animation_.meta));
        file.add(container::type::conn, ByteView(topology_.bytes));
        const bool renumbered = options_.order == Order::free;
        const Appearance& appearance = animation_.appearance;
        MESHREEL_CHECK(container::add_appearance(
            file, renumbered ? reordered(appearance, {topology_.vertex_of, topology_.corner_of}) : appearance,
            {animation_.vertex_count, topology_.topology.triangles}));
        for (std::size_t s = 0; s < segments_.size(); ++s)
            MESHREEL_CHECK(file.add(container::type::segm,
                                    container::Segment{static_cast<std::uint32_t>(segments_[s].first),
                                                       static_cast<std::uint32_t>(segments_[s].count), payloads_[s]}));
        return std::move(file).finish();
    }

    /// The file of the present payloads, decoded again and measured in the original order.
    Result<Encoded> finished() const
    {
        Encoded encoded;
        DecodeOptions verification;
        verification.base = options_.base;
        verification.threads = options_.threads;
        MESHREEL_TRY(encoded.bytes, assembled());
        MESHREEL_TRY(Animation decoded, decode(encoded.bytes, verification));
        if (options_.order == Order::free) put_back(decoded);
        decoded.triangles = animation_.triangles;
        encoded.kg = metrics::kg_error(animation_, decoded, options_.threads);
        encoded.max_error = largest_distance(metrics::pair_of(animation_, decoded));
        encoded.bpfv = 8.0 * static_cast<double>(encoded.bytes.size()) /
                       (static_cast<double>(animation_.frame_count()) * animation_.vertex_count); // (9.1)
        encoded.bases = tried_.bases;
        encoded.step = tried_.step / diagonal();
        return encoded;
    }

    /// Positions in the original order.
    void put_back(Animation& decoded) const
    {
        std::vector<float> frame(decoded.vertex_count * 3ul);
        for (std::size_t f = 0; f < decoded.frame_count(); ++f) {
            std::ranges::copy(decoded.frame(f), frame.begin());
            for (std::size_t i = 0; i < topology_.vertex_of.size(); ++i)
                std::copy_n(frame.data() + 3 * i, 3, decoded.frame(f).data() + 3ul * topology_.vertex_of[i]);
        }
    }

    const Animation& animation_;
    const EncodeOptions& options_;
    const codecs::Codec& codec_;
    connectivity::Encoded topology_;
    std::vector<FrameSpan> segments_;
    Matrix<float> frames_; ///< [F x 3W] in surface order
    std::vector<std::unique_ptr<codecs::Encoder>> encoders_;
    std::size_t max_bases_ = 0;
    bool by_kg_ = true;
    double target_ = 0.0; ///< KG error in percent, or largest error in model units

    std::vector<Bytes> payloads_; ///< of the latest attempt, one a segment
    codecs::Trial tried_;         ///< sums and extremes of it
};

Status check_quality(const Quality& quality)
{
    int targets = 0;
    for (const std::optional<double>& target : {quality.kg, quality.max_error, quality.max_error_relative}) {
        targets += target.has_value();
        if (target && !(*target > 0 && std::isfinite(*target))) return usage("a quality target must be above 0");
    }
    const bool by_hand = quality.bases || quality.step;
    if (targets + by_hand > 1) return usage("ask for one of kg, max_error, max_error_relative, or bases and step");
    if (quality.step && !(*quality.step > 0 && std::isfinite(*quality.step))) return usage("step must be above 0");
    if (quality.bases && *quality.bases == 0) return usage("bases must be above 0");
    return Ok{};
}

Status check_base(const Animation& animation, const EncodeOptions& options)
{
    if (options.order != Order::base)
        return options.base == nullptr ? Status(Ok{}) : usage("a base mesh is given, but the order is not base");
    if (options.base == nullptr) return usage("order base needs a base mesh");
    if (options.base->vertex_count != animation.vertex_count)
        return usage(concat("the base mesh has ", options.base->vertex_count, " vertices, the animation ",
                            animation.vertex_count));
    if (options.base->triangles != animation.triangles)
        return usage("the base mesh has other triangles than the animation");
    return Ok{};
}

} // namespace

Result<Encoded> encode(const Animation& animation, const EncodeOptions& options)
{
    MESHREEL_CHECK(validate(animation));
    MESHREEL_CHECK(check_quality(options.quality));
    MESHREEL_CHECK(check_base(animation, options));
    const codecs::Codec* codec = codecs::find(options.codec);
    if (codec == nullptr) return usage(concat("there is no codec \"", options.codec, "\""));
    return Encoding(animation, options, *codec).encode();
}

Animation in_free_order(const Animation& animation, Threads threads)
{
    const connectivity::Encoded topology = connectivity::encode(
        {animation.vertex_count, animation.triangles, weld(animation, threads).unique_of}, Order::free);
    Animation result = animation;
    result.triangles = topology.topology.triangles;
    for (std::size_t f = 0; f < animation.frame_count(); ++f)
        reorder_frame(animation.frame(f), topology.vertex_of, result.frame(f));
    result.appearance = reordered(animation.appearance, {topology.vertex_of, topology.corner_of});
    return result;
}

} // namespace meshreel
