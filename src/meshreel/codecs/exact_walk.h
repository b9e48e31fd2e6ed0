/// The walk over exact values: one coordinate of all vertices, frame after frame. One template for both directions.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "meshreel/codecs/vertex_ring.h"
#include "meshreel/coding/mixed_levels.h"
#include "meshreel/coding/model.h"
#include "meshreel/coding/number_line.h"
#include "meshreel/coding/range_coder.h"
#include "meshreel/predict/least_squares.h"

namespace meshreel::codecs {

/// A place between two numbers of the line where a value is expected, and how far off that has been around there.
struct Expectation {
    std::int64_t nearest; ///< the number closest to it
    double beside;        ///< the expected place less that number's, [-0.5, 0.5]
    double doubt;         ///< the distance to be expected, in steps of the line
};

/// Codes numbers of a line by how many steps they are from where they are expected.
template <class Core>
class StepModel {
public:
    /// The number that was found. Writing: `wanted` is stored.
    std::int64_t code(Core& core, const Expectation& expected, std::int64_t wanted)
    {
        const std::uint32_t column = coding::octave_column<2>(expected.doubt, columns);
        const double size = expected.beside < 0 ? -expected.beside : expected.beside;
        const auto part = static_cast<std::uint32_t>(std::min(size * 16, 7.0));
        const std::int64_t steps = Core::writes ? wanted - expected.nearest : 0;
        const std::uint64_t far = static_cast<std::uint64_t>(steps < 0 ? -steps : steps);
        if (!core.bit(off_[column][part], far != 0)) return expected.nearest;
        const bool toward = core.bit(toward_[column][part], (steps < 0) == (expected.beside < 0));
        const auto value = static_cast<std::int64_t>(magnitude(core, column, far));
        return expected.nearest + (toward == (expected.beside < 0) ? -value : value);
    }

private:
    static constexpr std::uint32_t columns = 128, parts = 8, most_bits = 40, told = 3;

    /// 1 or more: how many bits, the highest ones, the rest plain.
    std::uint64_t magnitude(Core& core, std::uint32_t column, std::uint64_t wanted)
    {
        const auto wanted_width = static_cast<std::uint32_t>(std::min(coding::bit_width(wanted), int{most_bits}));
        const std::uint32_t width = 1 + widths_[column].code(core, wanted_width - 1);
        std::uint64_t value = 1;
        std::uint32_t left = width - 1;
        for (std::uint32_t node = 1, t = 0; left > 0 && t < told; ++t, --left) {
            const bool bit = core.bit(high_[width][node], wanted >> (left - 1) & 1u);
            value = value << 1 | (bit ? 1u : 0u);
            node = node << 1 | (bit ? 1u : 0u);
        }
        for (; left > 0; left -= std::min(left, 16u)) {
            const std::uint32_t now = std::min(left, 16u), rest = left - now;
            value = value << now |
                    core.raw(static_cast<std::uint32_t>(wanted >> rest & ((1u << now) - 1u)), static_cast<int>(now));
        }
        return value;
    }

    std::array<std::array<coding::Bit, parts>, columns> off_, toward_;
    std::vector<coding::TreeModel> widths_ = std::vector<coding::TreeModel>(columns, coding::TreeModel(most_bits));
    std::array<std::array<coding::Bit, 1u << told>, most_bits + 1> high_;
};

/// Codes one coordinate of all frames. Its guess is a base (another codec's frames before rounding, or the frame before),
/// plus what the base is expected to miss: as much as it missed around there and just before, by weights that learn.
template <class Core>
class ExactWalk {
public:
    /// Everything must outlive the walk.
    ExactWalk(Core& core, const coding::NumberLine& line, const VertexRing& ring)
        : core_(core), line_(line), ring_(ring),
          corrected_(ring.size(), 0), missed_{Values(ring.size()), Values(ring.size()), Values(ring.size())},
          wrong_{Values(ring.size()), Values(ring.size())}
    {
    }

    using Place = std::conditional_t<Core::writes, const float, float>;
    /// One coordinate of a frame, [W] at a distance of 3 each.
    struct Frame {
        Place* now;          ///< the values; reading: where they go
        const float* before; ///< of the frame before; null for the first
        const double* base;  ///< null where there is none
    };

    void code(const Frame& frame)
    {
        std::rotate(missed_.rbegin(), missed_.rbegin() + 1, missed_.rend());
        std::swap(wrong_[0], wrong_[1]);
        for (std::size_t v = 0; v < ring_.size(); ++v) code_value(frame, v);
        ++frames_;
    }

private:
    using Values = std::vector<double>;
    using Learner = predict::LeastSquares<9>;
    static constexpr double memory = 0.999;

    void code_value(const Frame& frame, std::size_t v)
    {
        const double base = base_of(frame, v), usual = usual_miss(v);
        const double unit = 1.0 / (usual + 0.25 * line_.step(base));
        typename Learner::Features u = features(v);
        for (double& feature : u) feature *= unit;
        Learner& learner = learners_[frames_ == 0 ? 0 : 1];
        double correction = learner.predict(u);
        if (!(correction > -wildest && correction < wildest)) { // it has lost its way
            learner = Learner(memory);
            correction = 0;
        }
        const double guess = base + correction / unit;
        const float found = code_number(guess, usual, v, Core::writes ? frame.now[3 * v] : 0.0f);
        if constexpr (!Core::writes) frame.now[3 * v] = found;
        missed_[0][v] = static_cast<double>(found) - base;
        const double wrong = static_cast<double>(found) - guess;
        wrong_[0][v] = wrong < 0 ? -wrong : wrong;
        learner.learn(u, missed_[0][v] * unit - correction);
    }

    /// The number on the line, and where the line does not have the value, how many float32 it is off.
    float code_number(double guess, double usual, std::size_t v, float wanted)
    {
        const double place = line_.position(guess);
        const auto nearest = static_cast<std::int64_t>(place < 0 ? place - 0.5 : place + 0.5);
        const Expectation expected{nearest, place - static_cast<double>(nearest), usual / line_.step(guess)};
        const std::int64_t wanted_number = Core::writes ? number_of(wanted) : 0;
        const std::int64_t number = steps_.code(core_, expected, wanted_number);
        const float on_line = line_.at(number);
        return line_.decimal ? corrected(on_line, v, wanted) : on_line;
    }

    /// A value that a text did not make as the line thinks: so many float32 beside it. Where float32 are dense, a little
    /// more arithmetic behind the text is seen at once.
    float corrected(float on_line, std::size_t v, float wanted)
    {
        const double x = static_cast<double>(on_line);
        const std::uint32_t density = coding::octave_column<0>(line_.step(x) / coding::NumberLine{}.step(x), densities);
        const std::int64_t off = Core::writes ? coding::float_place(wanted) - coding::float_place(on_line) : 0;
        const std::int32_t stored = corrections_[density][corrected_[v]].code(core_, static_cast<std::int32_t>(off));
        corrected_[v] = stored == 0 ? 0 : stored == 1 || stored == -1 ? 1 : 2;
        return stored == 0 ? on_line : coding::float_at(coding::float_place(on_line) + stored);
    }

    std::int64_t number_of(float value) const
    {
        return line_.decimal ? line_.nearest(static_cast<double>(value)) : coding::float_place(value);
    }

    /// What is known before anything is learned.
    double base_of(const Frame& frame, std::size_t v) const
    {
        if (frame.base != nullptr) return frame.base[3 * v];
        if (frame.before != nullptr) return static_cast<double>(frame.before[3 * v]);
        const auto value = [&](std::size_t u) { return static_cast<double>(frame.now[3 * u]); };
        if (!ring_.parallelograms(v).empty()) return parallelogram(value, v);
        if (!ring_.earlier(v).empty()) return value(ring_.earlier(v).back());
        return v > 0 ? value(v - 1) : 0.0;
    }

    /// How wrong guesses have been around v, model units.
    double usual_miss(std::size_t v) const
    {
        double sum = 0, weight = 0;
        for (std::uint32_t u : ring_.earlier(v)) sum += wrong_[0][u];
        weight += static_cast<double>(ring_.earlier(v).size());
        if (frames_ > 0) {
            sum += 2 * wrong_[1][v];
            for (std::uint32_t u : ring_.later(v)) sum += 0.5 * wrong_[1][u];
            weight += 2 + 0.5 * static_cast<double>(ring_.later(v).size());
        } else if (v > 0) {
            sum += wrong_[0][v - 1];
            weight += 1;
        }
        return weight > 0 ? sum / weight : 1.0;
    }

    static double mean(const Values& values, std::span<const std::uint32_t> where)
    {
        double sum = 0;
        for (std::uint32_t u : where) sum += values[u];
        return where.empty() ? 0.0 : sum / static_cast<double>(where.size());
    }

    /// The mean of the parallelograms (8.1) that end at v, which has some.
    template <class Value>
    double parallelogram(const Value& value, std::size_t v) const
    {
        double sum = 0;
        for (const connectivity::Parallelogram& p : ring_.parallelograms(v))
            sum += value(p.left) + value(p.right) - value(p.opposite); // (8.1)
        return sum / static_cast<double>(ring_.parallelograms(v).size());
    }

    /// The same of misses, or the mean of the neighbours'.
    double parallelogram_of(const Values& values, std::size_t v) const
    {
        if (ring_.parallelograms(v).empty()) return mean(values, ring_.earlier(v));
        return parallelogram([&](std::size_t u) { return values[u]; }, v);
    }

    /// What the base missed around v in this frame, and there and in v in the frames before.
    typename Learner::Features features(std::size_t v) const
    {
        const auto earlier = ring_.earlier(v), later = ring_.later(v);
        return {mean(missed_[0], earlier),
                parallelogram_of(missed_[0], v),
                v > 0 ? missed_[0][v - 1] : 0.0,
                earlier.empty() ? 0.0 : missed_[0][earlier.front()],
                missed_[1][v],
                mean(missed_[1], earlier),
                mean(missed_[1], later),
                parallelogram_of(missed_[1], v),
                missed_[2][v]};
    }

    static constexpr double wildest = 1e4;

    Core& core_;
    const coding::NumberLine& line_;
    const VertexRing& ring_;
    std::size_t frames_ = 0;
    std::array<Learner, 2> learners_{Learner(memory), Learner(memory)}; ///< of the first frame; of all others
    StepModel<Core> steps_;
    static constexpr std::uint32_t densities = 32;
    std::array<std::array<coding::LevelModel, 3>, densities> corrections_;
    std::vector<std::uint8_t> corrected_; ///< [W] size of the correction in the frame before: 0, 1 or 2 for more
    std::array<Values, 3> missed_;        ///< [W] value less base, in this frame and the two before
    std::array<Values, 2> wrong_;         ///< [W] |value less guess|, in this frame and the one before
};

} // namespace meshreel::codecs
