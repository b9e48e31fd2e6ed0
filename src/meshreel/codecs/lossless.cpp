/// lossless' two directions: the guess, the lines of numbers, three walks side by side.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/lossless.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>

#include "meshreel/base/text.h"
#include "meshreel/codecs/components.h"
#include "meshreel/codecs/entropy.h"
#include "meshreel/codecs/exact_walk.h"
#include "meshreel/codecs/number_source.h"
#include "meshreel/container/explain.h"

namespace meshreel::codecs {

namespace {

using coding::NumberLine;

constexpr const char* guessing_codec = "reel";
constexpr std::size_t frames_at_once = 8;      // guesses made together
constexpr std::uint64_t bytes_a_vertex = 1024; // what a walk may hold

struct LosslessPayload {
    struct Coordinate {
        NumberLine line;
        ByteView bits;

        void fields(auto& io)
        {
            io.flag("decimal", line.decimal, "values are decimals; or any float32");
            io.when(line.decimal, "decimal = yes", [&] {
                io.f64("scale", line.scale, container::finite, "what decimals are multiplied with");
                io.f64("offset", line.offset, container::finite, "added after that");
                io.u8("digits", line.digits, {1, NumberLine::most_digits}, "significant digits at most");
                io.u8("decimals", line.decimals, {0, NumberLine::most_decimals}, "digits after the point at most");
            });
            io.must(line.scale != 0, "scale", "is not 0");
            io.blob("bits", bits, container::any, "the values of this coordinate, see codecs/lossless.md");
        }
    };
    std::string guess_codec;
    ByteView guess;
    std::array<Coordinate, 3> coordinates;

    void fields(auto& io)
    {
        io.text("guess_codec", guess_codec, 32, "a codec of trajectories whose frames are a guess; empty: none");
        io.when(!guess_codec.empty(), "guess_codec is not empty",
                [&] { io.blob("guess", guess, container::any, "its payload"); });
        io.part("x", coordinates[0]);
        io.part("y", coordinates[1]);
        io.part("z", coordinates[2]);
    }
};

/// One range coder and one walk a coordinate.
template <class Core>
struct Strand {
    Strand(Core present, const NumberLine& line, const VertexRing& ring)
        : core(std::move(present)), walk(core, line, ring)
    {
    }
    Core core;
    ExactWalk<Core> walk;
};
template <class Core>
using Strands = std::array<std::unique_ptr<Strand<Core>>, 3>;
template <class Core>
using Frames = MatrixView<typename ExactWalk<Core>::Place>;

/// One more frame, unless reading makes no sense any more. base: [3W], or null.
template <class Core>
void walk_frame(Strand<Core>& strand, Frames<Core> frames, std::array<std::size_t, 2> frame_and_coordinate,
                const double* base)
{
    if (ended(strand.core)) return;
    const auto [f, c] = frame_and_coordinate;
    strand.walk.code({frames.row(f).data() + c, f > 0 ? frames.row(f - 1).data() + c : nullptr,
                      base != nullptr ? base + c : nullptr});
}

/// Walks all frames, [F x 3W], the three coordinates side by side. guess: null, or what makes a base for each frame.
template <class Core>
void walk_frames(Strands<Core>& strands, const Trajectories* guess, Frames<Core> frames, Threads threads)
{
    Matrix<double> base(guess != nullptr ? frames_at_once : 0, frames.cols);
    for (std::size_t first = 0; first < frames.rows; first += frames_at_once) {
        const std::size_t count = std::min(frames_at_once, frames.rows - first);
        if (guess != nullptr) {
            std::vector<FrameMix> mixes;
            for (std::size_t f = first; f < first + count; ++f) mixes.push_back(only(static_cast<std::uint32_t>(f)));
            pose(*guess, {mixes, 0}, {base.values.data(), count, base.cols}, threads);
        }
        parallel_for(3, threads, [&](std::size_t c) {
            for (std::size_t i = 0; i < count; ++i)
                walk_frame(*strands[c], frames, {first + i, c}, guess != nullptr ? base.row(i).data() : nullptr);
        });
    }
}

/// The three coordinates' bits.
std::array<Bytes, 3> written_frames(const Sequence& sequence, const std::array<NumberLine, 3>& lines,
                                    const Trajectories* guess, Threads threads)
{
    const VertexRing ring(sequence.surface);
    Strands<coding::RangeEncoder> strands;
    for (std::size_t c = 0; c < 3; ++c)
        strands[c] = std::make_unique<Strand<coding::RangeEncoder>>(coding::RangeEncoder{}, lines[c], ring);
    walk_frames(strands, guess, sequence.frames, threads);
    return {strands[0]->core.finish(), strands[1]->core.finish(), strands[2]->core.finish()};
}

/// About how many bits values cost that are guessed with an error of so many steps, rms.
double bits_of_error(double steps)
{
    return std::log2(1 + 4.1 * steps); // nearly the entropy of a rounded normal distribution
}

class LosslessEncoder : public Encoder {
public:
    LosslessEncoder(const Sequence& sequence, Threads threads)
        : sequence_(sequence), lines_(number_lines(sequence.frames, threads)),
          guesser_(find(guessing_codec)->prepare(sequence, most_bases(sequence.surface.vertex_count), threads))
    {
        const std::size_t stride = 1 + sequence.frames.values().size() / 30000; // some of all coordinates
        for (std::size_t i = 0; i < sequence.frames.values().size(); i += stride)
            steps_.push_back(lines_[i % 3].step(static_cast<double>(sequence.frames.data[i])));
    }

    double energy() const override { return guesser_->energy(); }
    std::span<const double> singular_values() const override { return guesser_->singular_values(); }

    /// Only settings.growth and settings.threads matter.
    Trial encode(const Settings& settings) const override
    {
        const std::array<Bytes, 3> plain = written_frames(sequence_, lines_, nullptr, settings.threads);
        const Trial guess = best_guess(settings);
        if (likely_size(guess) < 1.2 * static_cast<double>(size_of(plain))) {
            const std::array<Bytes, 3> bits = written_frames(sequence_, lines_, &guess.decoded, settings.threads);
            if (size_of(bits) + guess.payload.size() < size_of(plain)) return assembled(bits, &guess);
        }
        return assembled(plain, nullptr);
    }

private:
    /// So many that the coefficients of the best guess, of the next one and of what they are made from stay small.
    static std::size_t most_bases(std::size_t W)
    {
        constexpr std::size_t most = 512, least = 16, memory = 250'000'000, bytes_each = 4 * sizeof(double);
        return std::clamp(memory / bytes_each / (W + 1), least, most);
    }

    static std::size_t size_of(const std::array<Bytes, 3>& bits)
    {
        return bits[0].size() + bits[1].size() + bits[2].size();
    }

    /// Of a guess and of what it leaves, bytes.
    double likely_size(const Trial& guess) const
    {
        const auto values = static_cast<double>(sequence_.frames.values().size());
        const double error = std::sqrt(guess.squared_error / values);
        double bits = 0;
        for (const double step : steps_) bits += bits_of_error(error / step);
        return static_cast<double>(guess.payload.size()) + bits / static_cast<double>(steps_.size()) * values / 8;
    }

    Trial guessed(const Settings& settings, double step) const
    {
        return guesser_->encode({.step = step, .growth = settings.growth, .threads = settings.threads});
    }

    /// The guess with which all is smallest, nearly: finer or coarser for as long as that helps.
    Trial best_guess(const Settings& settings) const
    {
        constexpr double ratio = 3.0;
        constexpr int most_turns = 5;
        double mean = 0;
        for (const double step : steps_) mean += std::log2(step);
        const double start = std::exp2(mean / static_cast<double>(steps_.size()));
        Trial best = guessed(settings, start);
        for (const double factor : {ratio, 1 / ratio}) {
            bool moved = false;
            double step = best.step;
            for (int turn = 0; turn < most_turns; ++turn) {
                Trial next = guessed(settings, step *= factor);
                if (!(likely_size(next) < likely_size(best))) break;
                best = std::move(next);
                moved = true;
            }
            if (moved) break;
        }
        return best;
    }

    Trial assembled(const std::array<Bytes, 3>& bits, const Trial* guess) const
    {
        LosslessPayload payload;
        for (std::size_t c = 0; c < 3; ++c) payload.coordinates[c] = {lines_[c], bits[c]};
        if (guess != nullptr) {
            payload.guess_codec = guessing_codec;
            payload.guess = guess->payload;
        }
        Result<Bytes> bytes = container::write_fields(payload);
        assert(bytes.ok());
        Trial trial{};
        trial.payload = *std::move(bytes);
        if (guess != nullptr) trial.bases = guess->bases;
        if (guess != nullptr) trial.step = guess->step;
        return trial;
    }

    Sequence sequence_;
    std::array<NumberLine, 3> lines_;
    std::unique_ptr<Encoder> guesser_;
    std::vector<double> steps_; ///< of the lines, at some of the values
};

std::unique_ptr<Encoder> prepare_lossless(const Sequence& sequence, std::size_t, Threads threads)
{
    return std::make_unique<LosslessEncoder>(sequence, threads);
}

container::Source guess_source(const LosslessPayload& payload, const container::Source& source)
{
    const auto offset = static_cast<std::uint64_t>(payload.guess.data() - source.bytes.data());
    return {payload.guess, source.offset + offset, source.name + ".guess"};
}

/// The guess of a payload; none where it has none.
Result<std::optional<Trajectories>> open_guess(const LosslessPayload& payload, const Coded& coded)
{
    if (payload.guess_codec.empty()) return std::optional<Trajectories>{};
    const Codec* codec = find(payload.guess_codec);
    if (codec == nullptr || codec->exact())
        return unsupported(payload.guess_codec + " is no codec of trajectories", coded.payload.name + ".guess_codec");
    Coded inner = coded;
    inner.payload = guess_source(payload, coded.payload);
    MESHREEL_TRY(Trajectories trajectories, codec->open(inner));
    return std::optional<Trajectories>(std::move(trajectories));
}

Status read_lossless(const Coded& coded, MatrixView<float> frames)
{
    const container::Source& source = coded.payload;
    MESHREEL_TRY(const LosslessPayload payload, container::read_fields<LosslessPayload>(source, coded.limits));
    if (coded.surface.vertex_count > coded.limits.max_memory / bytes_a_vertex)
        return bad_input("its vertices do not fit in the memory limit", source.name, at_byte(source.offset));
    MESHREEL_TRY(const std::optional<Trajectories> guess, open_guess(payload, coded));
    const VertexRing ring(coded.surface);
    Strands<coding::RangeDecoder> strands;
    for (std::size_t c = 0; c < 3; ++c)
        strands[c] = std::make_unique<Strand<coding::RangeDecoder>>(coding::RangeDecoder{payload.coordinates[c].bits},
                                                                    payload.coordinates[c].line, ring);
    walk_frames(strands, guess ? &*guess : nullptr, frames, coded.threads);
    for (std::size_t c = 0; c < 3; ++c)
        MESHREEL_CHECK(at_part(complete(strands[c]->core), source, payload.coordinates[c].bits,
                               joined(std::string_view("xyz").substr(c, 1), ".bits")));
    return Ok{};
}

Status explain_lossless(const container::Source& source, const DecodeLimits& limits, std::string& lines)
{
    MESHREEL_CHECK(container::explain_fields<LosslessPayload>(source, limits, lines));
    MESHREEL_TRY(const LosslessPayload payload, container::read_fields<LosslessPayload>(source, limits));
    const Codec* codec = find(payload.guess_codec);
    if (codec == nullptr || codec->exact()) return Ok{};
    return codec->explain(guess_source(payload, source), limits, lines);
}

} // namespace

Codec lossless()
{
    return {"lossless",
            "every float32 exactly as it was; another codec makes the guess",
            encoder_side(prepare_lossless),
            nullptr,
            encoder_side(explain_lossless),
            read_lossless};
}

} // namespace meshreel::codecs
