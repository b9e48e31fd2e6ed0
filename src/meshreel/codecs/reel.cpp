/// reel's two directions: basis as poses, first components along the surface, the others from coarse to fine.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/reel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "meshreel/base/text.h"
#include "meshreel/codecs/choice.h"
#include "meshreel/codecs/components.h"
#include "meshreel/codecs/entropy.h"
#include "meshreel/codecs/length_guess.h"
#include "meshreel/codecs/level_walk.h"
#include "meshreel/codecs/pose_walk.h"
#include "meshreel/codecs/reel_payload.h"
#include "meshreel/codecs/relaxation.h"
#include "meshreel/codecs/surface_walk.h"
#include "meshreel/container/explain.h"

namespace meshreel::codecs {

namespace {

constexpr std::uint64_t most_length_bytes = std::uint64_t{1} << 29; // that an encoder asks of its readers

/// The three streams of a payload.
struct ReelBits {
    ByteView basis, first, levels;
    std::vector<std::uint64_t> level_ends; ///< [levels] bytes of `levels` up to each level's end, the coarsest first
};

/// Of a payload that may end with any level. @fails bad_input: it ends before all levels, or goes on after the last.
Result<ReelBits> bits_of(const ReelPayload& payload, const container::Source& source)
{
    const std::uint64_t size = payload.bits.size();
    const auto wrong = [&](const char* message, const char* field) {
        return bad_input(message, source.name + "." + field, at_byte(source.offset + source.bytes.size()));
    };
    if (payload.basis_size > size) return wrong("ends too early", "basis_bits");
    if (payload.first_size > size - payload.basis_size) return wrong("ends too early", "first_bits");
    const std::size_t basis = static_cast<std::size_t>(payload.basis_size),
                      first = static_cast<std::size_t>(payload.first_size);
    ReelBits bits{
        payload.bits.first(basis), payload.bits.subspan(basis, first), payload.bits.subspan(basis + first), {}};
    std::uint64_t end = 0;
    for (const LevelSize& level : payload.levels) bits.level_ends.push_back(end += level.bytes);
    if (bits.levels.size() > end) return wrong("goes on after its last level", "level_bits");
    return bits;
}

constexpr std::size_t first_components = SurfaceWalk<coding::RangeEncoder>::most;

/// Basis and mean as poses, [F x 3(K+1)]: the mean's weight is sqrt(W), an eigentrajectory's its singular value.
Matrix<double> poses_of(const linalg::Pca& pca, std::size_t K, const ReelPayload& head, double W)
{
    const std::size_t F = pca.mean.size() / 3;
    Matrix<double> Y(F, 3 * (K + 1));
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t c = 0; c < 3; ++c) {
            Y(f, c) = std::sqrt(W) * (pca.mean[c * F + f] - head.origin[c]);
            for (std::size_t k = 0; k < K; ++k)
                Y(f, 3 * (k + 1) + c) = pca.singular_values[k] * pca.basis(k, c * F + f);
        }
    return Y;
}

/// A basis of unit vectors, and the energies that its poses had.
struct WeighedBasis {
    Basis basis;
    std::vector<double> energies; ///< [K]
};

/// What decoder and encoder make of coded poses.
WeighedBasis basis_of(MatrixView<const double> Y, const ReelPayload& head, double W)
{
    const std::size_t F = Y.rows, K = Y.cols / 3 - 1;
    WeighedBasis result{{std::vector<double>(3 * F), Matrix<double>(K, 3 * F)}, std::vector<double>(K, 0.0)};
    const double unit = 1.0 / std::sqrt(W);
    for (std::size_t k = 0; k < K; ++k)
        for (std::size_t f = 0; f < F; ++f)
            for (std::size_t c = 0; c < 3; ++c) result.energies[k] += Y(f, 3 * (k + 1) + c) * Y(f, 3 * (k + 1) + c);
    for (std::size_t f = 0; f < F; ++f)
        for (std::size_t c = 0; c < 3; ++c) result.basis.mean[c * F + f] = head.origin[c] + unit * Y(f, c);
    for (std::size_t k = 0; k < K; ++k) {
        const double scale = result.energies[k] > 0 ? 1.0 / std::sqrt(result.energies[k]) : 0.0;
        for (std::size_t f = 0; f < F; ++f)
            for (std::size_t c = 0; c < 3; ++c) result.basis.rows(k, c * F + f) = scale * Y(f, 3 * (k + 1) + c);
    }
    return result;
}

/// The components that place the vertices, [W x 3]; 0 where C has fewer.
Matrix<double> first_of(MatrixView<const double> C)
{
    Matrix<double> first(C.rows, first_components);
    for (std::size_t v = 0; v < C.rows; ++v)
        std::copy_n(C.row(v).data(), std::min(C.cols, first_components), first.row(v).data());
    return first;
}

/// Products a coordinate that guesses keeping lengths cost, of all batches.
std::uint64_t length_terms(const InterpolationLaw& law, std::size_t K)
{
    std::uint64_t terms = 0;
    for (std::size_t k = first_components; k < K; k = law.batch_end(k, K)) terms += LengthGuess::terms(K);
    return terms;
}

/// From coarse to fine.
std::vector<std::size_t> rising(std::vector<std::size_t> counts)
{
    std::ranges::reverse(counts);
    return counts;
}

/// [W x K] and the magnitudes of their levels; the first of them are known.
struct Coefficients {
    MatrixView<double> C;
    MatrixView<std::uint8_t> L;
    std::size_t first;
};

/// How the components after the first ones are coded.
struct LevelsWay {
    const ReelPayload& head;
    const Interpolation& interpolation;
    const Basis& basis;
    Threads threads;
    double bit_price = 0.0;
};

/// Both directions: see LevelWalk::code.
template <class Core>
std::vector<std::uint64_t> code_levels(Core& core, const LevelsWay& way, const Coefficients& all,
                                       std::span<const std::size_t> ends)
{
    std::optional<LengthGuess> lengths;
    if (way.head.has(way_lengths)) lengths.emplace(way.basis, all.C.rows, way.threads);
    const Taper taper{{way.head.step, way.bit_price}, way.head.taper_exponent()};
    return way.head.with_contexts([&](auto contexts) {
        return LevelWalk<Core, contexts>(core, way.interpolation, taper, lengths ? &*lengths : nullptr)
            .code(all.first, all.C, all.L, ends);
    });
}

class ReelEncoder : public ComponentEncoder {
public:
    using ComponentEncoder::ComponentEncoder;

    Trial encode(const Settings& settings) const override
    {
        Settings usual = settings;
        usual.lengths = settings.lengths && lengths_fit(pca_.singular_values.size());
        Trial trial = encode_as(usual);
        if (!usual.lengths || lengths_pay(settings.growth, trial)) return trial;
        usual.lengths = false;
        return encode_as(usual);
    }

private:
    /// Whether readers have room for them.
    bool lengths_fit(std::size_t K) const
    {
        return LengthGuess::bytes(sequence_.surface.vertex_count, sequence_.frames.rows, K) <= most_length_bytes;
    }

    /// Whether there is a guess at all, and readers do not refuse its work for so few bytes, nor for those of a coarse
    /// level, half of the file at least.
    bool lengths_pay(std::uint32_t growth, const Trial& trial) const
    {
        InterpolationLaw law;
        law.growth = growth;
        const std::uint64_t coordinates = 3 * std::uint64_t{sequence_.surface.vertex_count} * sequence_.frames.rows;
        const std::uint64_t terms = length_terms(law, trial.bases);
        return terms > 0 && within_work({}, coordinates, 2 * terms, trial.payload.size()).ok();
    }

    Trial encode_as(const Settings& settings) const
    {
        CodedBasis coded = code_basis(settings);
        return trial_of(std::move(coded.basis), settings, [&](const Basis& basis, MatrixView<double> C) {
            code_coefficients(coded, settings, basis, C);
            if (settings.relax) relax(coded.head, basis, C, settings.threads);
            coded.head.bits = coded.bits;
            return coded.head;
        });
    }

    struct CodedBasis {
        ReelPayload head;
        Basis basis;
        std::vector<double> energies;
        Bytes bits; ///< of the payload
    };

    /// A basis as the decoder will see it. A component that the step leaves nothing of ends it.
    CodedBasis code_basis(const Settings& settings) const
    {
        const double W = sequence_.surface.vertex_count;
        const std::size_t F = pca_.mean.size() / 3;
        CodedBasis coded;
        coded.head.step = step_of(settings, pca_.singular_values, W);
        coded.head.first_step = settings.first_ratio * coded.head.step;
        coded.head.basis_step = settings.basis_ratio * coded.head.step;
        coded.head.taper = static_cast<std::uint32_t>(std::lround(settings.taper * taper_one));
        coded.head.law = {settings.linear, settings.squared_bend, coded.head.step, settings.growth,
                          settings.neighbours};
        coded.head.ways = (settings.mixed ? way_mixed : 0) | (settings.lengths ? way_lengths : 0);
        for (std::size_t c = 0; c < 3; ++c) coded.head.origin[c] = static_cast<float>(pca_.mean[c * F]);
        for (std::size_t K = bases_of(settings, pca_.singular_values, W);;) {
            Matrix<double> Y = poses_of(pca_, K, coded.head, W);
            coded.bits = range_written([&](coding::RangeEncoder& core) {
                PoseWalk(core, coding::Quantiser{coded.head.basis_step, settings.bit_price}).code(Y.view());
            });
            WeighedBasis weighed = basis_of(Y.view(), coded.head, W);
            const auto nothing = std::find(weighed.energies.begin(), weighed.energies.end(), 0.0);
            if (nothing == weighed.energies.end()) {
                coded.head.bases = static_cast<std::uint32_t>(K);
                coded.head.basis_size = coded.bits.size();
                coded.basis = std::move(weighed.basis);
                coded.energies = std::move(weighed.energies);
                return coded;
            }
            K = static_cast<std::size_t>(nothing - weighed.energies.begin());
        }
    }

    /// Relaxes decoded coefficients as the decoder will, and says for which noise.
    void relax(ReelPayload& head, const Basis& basis, MatrixView<double> C, Threads threads) const
    {
        constexpr double trust = 2.0; // neighbours err alike: their lengths err less than they do
        const Relaxation relaxation(sequence_.surface.triangles, basis, threads);
        const double deviation = std::sqrt(trust * relaxation.noise_of(C, sequence_.frames)) / (head.step * noise_unit);
        head.length_noise = static_cast<std::uint32_t>(std::lround(std::min<double>(deviation, most_noise)));
        relaxation.relax(C, head.relaxed_noise());
    }

    /// Adds the bits of the coefficients, and their sizes.
    void code_coefficients(CodedBasis& coded, const Settings& settings, const Basis& basis, MatrixView<double> C) const
    {
        const std::size_t first = std::min(C.cols, first_components);
        Matrix<std::uint8_t> L(C.rows, C.cols);
        const Bytes first_bits = range_written([&](coding::RangeEncoder& core) {
            SurfaceWalk(core, sequence_.surface, {coded.head.first_step, settings.bit_price}).code(first, C, L.view());
        });
        coded.head.first_size = first_bits.size();
        const Interpolation interpolation(first_of(C).view(), relevance_of(coded.energies), coded.head.law,
                                          settings.threads);
        const std::vector<std::size_t> counts = rising(detail_counts(interpolation.order()));
        std::vector<std::uint64_t> ends(counts.size(), 0);
        Bytes level_bits;
        if (C.cols > first)
            level_bits = range_written([&](coding::RangeEncoder& core) {
                const LevelsWay way{coded.head, interpolation, basis, settings.threads, settings.bit_price};
                ends = code_levels(core, way, {C, L.view(), first}, counts);
            });
        std::uint64_t begin = 0;
        for (const std::uint64_t end : ends) {
            const std::uint64_t there = std::min<std::uint64_t>(end, level_bits.size());
            coded.head.levels.push_back({there - begin});
            begin = there;
        }
        coded.bits.insert(coded.bits.end(), first_bits.begin(), first_bits.end());
        coded.bits.insert(coded.bits.end(), level_bits.begin(), level_bits.end());
    }
};

std::unique_ptr<Encoder> prepare_reel(const Sequence& sequence, std::size_t max_bases, Threads threads)
{
    return std::make_unique<ReelEncoder>(sequence, max_bases, threads);
}

/// A payload's parts, and how to read one.
struct ReelReader {
    const container::Source& source;
    ReelPayload head;
    ReelBits bits;
    std::size_t K = 0, first = 0;

    static Result<ReelReader> open(const Coded& coded)
    {
        MESHREEL_TRY(ReelPayload head, container::read_fields<ReelPayload>(coded.payload, coded.limits));
        MESHREEL_CHECK(check_bases(coded, head.bases));
        head.law.step = head.step;
        MESHREEL_TRY(ReelBits bits, bits_of(head, coded.payload));
        if (head.bases <= first_components && bits.level_ends.back() > 0)
            return bad_input("is not empty, but there are no further components", coded.payload.name + ".level_bits",
                             at_byte(coded.payload.offset));
        const std::size_t K = head.bases;
        return ReelReader{coded.payload, std::move(head), std::move(bits), K, std::min(K, first_components)};
    }

    Status read(ByteView part, const char* field, const auto& body) const
    {
        return at_part(range_taken(part, body), source, part, field);
    }

    Status poses(MatrixView<double> Y) const
    {
        return read(bits.basis, "basis_bits",
                    [&](coding::RangeDecoder& core) { PoseWalk(core, coding::Quantiser{head.basis_step}).code(Y); });
    }

    Status first_components_of(const connectivity::Surface& surface, MatrixView<double> C,
                               MatrixView<std::uint8_t> L) const
    {
        return read(bits.first, "first_bits", [&](coding::RangeDecoder& core) {
            SurfaceWalk(core, surface, coding::Quantiser{head.first_step}).code(first, C, L);
        });
    }

    /// @fails bad_input: another number of levels than the vertices make.
    Status check_levels(std::span<const std::size_t> counts) const
    {
        if (counts.size() == bits.level_ends.size()) return Ok{};
        return bad_input(
            concat("there are ", bits.level_ends.size(), " levels of detail, but its vertices make ", counts.size()),
            source.name + ".levels", at_byte(source.offset));
    }
};

/// Counts up to the coarsest level that has all vertices wanted, rising.
std::vector<std::size_t> counts_wanted(std::vector<std::size_t> counts, const CoarseToFine& order, const Coded& coded)
{
    if (!coded.wanted) return counts;
    std::vector<bool> missing(order.order.size());
    for (const std::uint32_t v : *coded.wanted) missing[v] = true;
    std::size_t last = order.order.size();
    while (last > 0 && !missing[order.order[last - 1]]) --last;
    const auto end = std::ranges::lower_bound(counts, last);
    if (end != counts.end()) counts.erase(end + 1, counts.end());
    return counts;
}

/// @fails limit: what `field` asks for does not fit in memory beside the trajectories.
Status check_room(const ReelReader& reader, const Coded& coded, std::uint64_t needed, const char* field)
{
    const std::uint64_t there = 8 * std::uint64_t{reader.K} * (coded.surface.vertex_count + 3 * coded.frame_count);
    if (needed + there <= coded.limits.max_memory) return Ok{};
    return at_part(bad_input("what it asks for does not fit in the memory limit"), coded.payload, coded.payload.bytes,
                   field);
}

/// @fails limit: keeping lengths takes more memory or work than one file may.
Status check_lengths(const ReelReader& reader, const Coded& coded)
{
    if (!reader.head.has(way_lengths)) return Ok{};
    const std::uint64_t W = coded.surface.vertex_count, F = coded.frame_count;
    MESHREEL_CHECK(check_room(reader, coded, LengthGuess::bytes(W, F, reader.K), "ways"));
    const std::uint64_t terms = length_terms(reader.head.law, reader.K);
    return at_part(within_work(coded.limits, 3 * W * F, terms, coded.payload.bytes.size()), coded.payload,
                   coded.payload.bytes, "ways");
}

/// The components after the first ones.
Status read_levels(const ReelReader& reader, const Coded& coded, const LevelsWay& way, const Coefficients& result)
{
    const CoarseToFine& order = way.interpolation.order();
    std::vector<std::size_t> counts = rising(detail_counts(order));
    MESHREEL_CHECK(reader.check_levels(counts));
    counts = counts_wanted(std::move(counts), order, coded);
    const std::uint64_t needed = reader.bits.level_ends[counts.size() - 1];
    if (reader.bits.levels.size() < needed)
        return at_part(bad_input("ends too early"), reader.source, reader.bits.levels, "level_bits");
    const ByteView bits = reader.bits.levels.first(static_cast<std::size_t>(needed));
    std::vector<std::uint64_t> ends;
    MESHREEL_CHECK(reader.read(bits, "level_bits",
                               [&](coding::RangeDecoder& core) { ends = code_levels(core, way, result, counts); }));
    if (std::ranges::equal(ends, std::span(reader.bits.level_ends).first(ends.size()))) return Ok{};
    return bad_input("a level of detail ends at another byte than said", reader.source.name + ".levels",
                     at_byte(reader.source.offset));
}

/// As coded.
Result<Trajectories> read_trajectories(const ReelReader& reader, const Coded& coded)
{
    const std::size_t W = coded.surface.vertex_count;
    Matrix<double> Y(coded.frame_count, 3 * (reader.K + 1));
    Trajectories result{{}, Matrix<double>(W, reader.K)};
    Matrix<std::uint8_t> L(W, reader.K);
    std::array<Status, 2> read{Ok{}, Ok{}};
    parallel_for(read.size(), coded.threads, [&](std::size_t part) { // neither needs the other
        read[part] =
            part == 0 ? reader.first_components_of(coded.surface, result.C.view(), L.view()) : reader.poses(Y.view());
    });
    MESHREEL_CHECK(read[1]);
    MESHREEL_CHECK(read[0]);
    WeighedBasis weighed = basis_of(Y.view(), reader.head, static_cast<double>(W));
    result.basis = std::move(weighed.basis);
    if (reader.K == reader.first) return result;
    const Interpolation interpolation(first_of(result.C.view()).view(), relevance_of(weighed.energies), reader.head.law,
                                      coded.threads);
    const LevelsWay way{reader.head, interpolation, result.basis, coded.threads};
    MESHREEL_CHECK(check_lengths(reader, coded));
    MESHREEL_CHECK(read_levels(reader, coded, way, {result.C.view(), L.view(), reader.first}));
    return result;
}

/// @fails limit: what it takes does not fit in memory beside the trajectories.
Status relax_decoded(const ReelReader& reader, const Coded& coded, Trajectories& decoded)
{
    const bool whole = !coded.wanted || coded.wanted->size() == decoded.C.rows; // a coarser level lacks the edges
    if (reader.head.length_noise == 0 || !whole) return Ok{};
    const std::uint64_t needed = Relaxation::bytes(decoded.C.rows, coded.surface.triangles.size(), decoded.C.cols);
    MESHREEL_CHECK(check_room(reader, coded, needed, "length_noise"));
    Relaxation(coded.surface.triangles, decoded.basis, coded.threads)
        .relax(decoded.C.view(), reader.head.relaxed_noise());
    return Ok{};
}

Result<Trajectories> open_reel(const Coded& coded)
{
    MESHREEL_TRY(const ReelReader reader, ReelReader::open(coded));
    MESHREEL_TRY(Trajectories decoded, read_trajectories(reader, coded));
    MESHREEL_CHECK(relax_decoded(reader, coded, decoded));
    return decoded;
}

Result<Detail> detail_reel(const Coded& coded)
{
    MESHREEL_TRY(const ReelReader reader, ReelReader::open(coded));
    const std::size_t W = coded.surface.vertex_count;
    Matrix<double> C(W, reader.first);
    Matrix<std::uint8_t> L(W, reader.first);
    MESHREEL_CHECK(reader.first_components_of(coded.surface, C.view(), L.view()));
    Detail detail{first_of(C.view()), {}, {}};
    CoarseToFine order = coarse_to_fine(detail.places.view(), 1, coded.threads);
    detail.counts = detail_counts(order);
    detail.order = std::move(order.order);
    MESHREEL_CHECK(reader.check_levels(detail.counts));
    return detail;
}

Result<std::vector<std::uint64_t>> level_bytes_reel(const container::Source& payload, const DecodeLimits& limits)
{
    MESHREEL_TRY(const ReelPayload head, container::read_fields<ReelPayload>(payload, limits));
    std::uint64_t end = payload.bytes.size() - head.bits.size() + head.basis_size + head.first_size;
    std::vector<std::uint64_t> ends;
    for (const LevelSize& level : head.levels) ends.push_back(end += level.bytes);
    std::ranges::reverse(ends);
    return ends;
}

Status explain_reel(const container::Source& source, const DecodeLimits& limits, std::string& lines)
{
    return container::explain_fields<ReelPayload>(source, limits, lines);
}

} // namespace

Codec reel()
{
    return {"reel",
            "PCA of trajectories, kriging from coarse to fine over vertices and over poses",
            encoder_side(prepare_reel),
            open_reel,
            encoder_side(explain_reel),
            nullptr,
            detail_reel,
            level_bytes_reel};
}

} // namespace meshreel::codecs
