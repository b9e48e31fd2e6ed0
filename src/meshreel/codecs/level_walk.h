/// All further components, from coarse to fine: a vertex is interpolated from its nearest vertices of coarser levels.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/exact.h"
#include "meshreel/base/parallel.h"
#include "meshreel/base/prefetch.h"
#include "meshreel/base/views.h"
#include "meshreel/codecs/contexts.h"
#include "meshreel/codecs/interpolation.h"
#include "meshreel/codecs/length_guess.h"
#include "meshreel/codecs/nearby_levels.h"
#include "meshreel/coding/mixed_levels.h"
#include "meshreel/coding/quantiser.h"

namespace meshreel::codecs {

/// How levels are quantised: the coarser, the finer, for on coarse ones all finer ones lean.
struct Taper {
    coding::Quantiser finest;
    double exponent = 0.0; ///< the step is in proportion to (vertices of coarser levels)^exponent, >= 0

    /// known: the share of vertices in coarser levels, [0, 1].
    coding::Quantiser at(double known) const
    {
        constexpr double least = 0.1, least_price = 0.3;
        const double fineness = known > 0 ? std::max(exact::power(known, exponent), least) : least;
        return {finest.step * fineness, finest.bit_price * (least_price + (1 - least_price) * known)};
    }
};

/// Codes components `first` .. K-1 level after level of a CoarseToFine order. Within a level components come in batches;
/// before each batch every vertex' weights are found anew from all components known of it and of its neighbours. Vertices
/// of a level do not depend on each other, so weights are found in parallel.
/// @cost O(W K n) and O(W n^2 K) for the weights, of n neighbours.
/// contexts: of each decision, 3 or, faster and some percent larger, the first alone.
template <class Core, std::size_t contexts>
class LevelWalk {
public:
    /// lengths: corrects what is interpolated; none: nothing does.
    LevelWalk(Core& core, const Interpolation& interpolation, Taper taper, LengthGuess* lengths)
        : core_(core), interpolation_(interpolation), taper_(taper), lengths_(lengths),
          levels_(some_of({near_columns * own_columns, rows * row_columns, seen_contexts}), judges)
    {
    }

    /// C [W x K], model units; columns before `first` are known. Writing: originals in. Afterwards C holds what the decoder
    /// sees. L [W x K]: magnitudes of all levels, up to 255. ends: vertices after which it is noted how far the bits have
    /// come, rising, each an end of the order's; the walk ends with the last.
    /// @return [ends] the bytes that a reader has taken there; fewer where bits are missing.
    std::vector<std::uint64_t> code(std::size_t first, MatrixView<double> C, MatrixView<std::uint8_t> L,
                                    std::span<const std::size_t> ends)
    {
        usual_.assign(C.cols, 1.0);
        own_.assign(C.rows, 0.5);
        const CoarseToFine& order = interpolation_.order();
        std::vector<std::uint64_t> taken;
        std::size_t begin = 0;
        for (std::size_t l = 0; l < order.ends.size() && taken.size() < ends.size(); ++l) {
            const std::size_t end = order.ends[l];
            const double known = static_cast<double>(begin) / static_cast<double>(C.rows);
            Level level{interpolation_.level(std::span(order.order).subspan(begin, end - begin)), taper_.at(known), C,
                        L};
            for (std::size_t k = first; k < C.cols && !ended(core_);) {
                const std::size_t next = interpolation_.batch_end(k);
                code_batch(level, k, next);
                k = next;
            }
            if (ended(core_)) break;
            if (lengths_) lengths_->know(level.near.vertices, C);
            if (end == ends[taken.size()]) taken.push_back(core_.position());
            begin = end;
        }
        return taken;
    }

private:
    static constexpr std::uint32_t near_columns = 22, own_columns = 18, rows = 96, row_columns = 14,
                                   seen_contexts = 243, judges = 12;

    using Places = typename coding::MixedLevels<contexts>::Places;

    struct Level {
        Interpolation::Level near;
        coding::Quantiser quantiser;
        MatrixView<double> C;
        MatrixView<std::uint8_t> L;
    };
    struct Place {
        std::size_t v, k;
        double guess, nearby; ///< nearby: how large the levels of the neighbours are
    };

    void code_batch(Level& level, std::size_t first, std::size_t last)
    {
        const std::vector<Interpolation::Weights> weights = interpolation_.weights(level.near, level.C, first);
        const Matrix<double> corrections =
            lengths_ ? lengths_->corrections(level.near.vertices, weights, level.C, {first, last}) : Matrix<double>();
        guess_.resize(last - first);
        nearby_.resize(last - first);
        for (std::size_t i = 0; i < weights.size() && !ended(core_); ++i) {
            const std::size_t v = level.near.vertices[i];
            if (i + 1 < weights.size()) fetch(weights[i + 1], first, level);
            weights[i].apply(level.C, first, guess_);
            if (lengths_) add(corrections.row(i), guess_);
            mean_of_nearby(std::span(weights[i].vertices).first(weights[i].count),
                           MatrixView<const std::uint8_t>(level.L), first, std::span(nearby_));
            for (std::size_t k = first; k < last; ++k)
                code_value(weights[i], {v, k, guess_[k - first], nearby_[k - first]}, level);
        }
    }

    /// Asks for what a batch from component `first` on will read of a vertex' neighbours.
    void fetch(const Interpolation::Weights& near, std::size_t first, const Level& level) const
    {
        for (std::size_t i = 0; i < near.count; ++i) {
            prefetch(level.C.row(near.vertices[i]).subspan(first, guess_.size()));
            prefetch(level.L.row(near.vertices[i]).subspan(first, guess_.size()));
        }
    }

    static void add(std::span<const double> correction, std::span<double> guess)
    {
        for (std::size_t k = 0; k < guess.size(); ++k) guess[k] += correction[k];
    }

    void code_value(const Interpolation::Weights& near, const Place& place, const Level& level)
    {
        const auto [v, k, guess, nearby] = place;
        double &value = level.C(v, k), &own = own_[v], &usual = usual_[k];
        const double expected = 0.45 * nearby + 0.3 * own + 0.25 * usual;
        const auto row = static_cast<std::uint32_t>(std::min<std::size_t>(k, rows - 1));
        const Places places = some_of(
            {coding::octave_column<1>(nearby, near_columns) * own_columns + coding::octave_column<1>(own, own_columns),
             row * row_columns + coding::octave_column<0>(expected, row_columns), seen(near, place, level.L)});
        const std::uint32_t judge = coding::octave_column<0>(expected, judges);
        const std::int32_t wanted = Core::writes ? levels_.choose(places, judge, level.quantiser, value - guess) : 0;
        const std::int32_t coded = levels_.code(core_, places, judge, wanted);
        value = bounded(guess + level.quantiser.value(coded));
        const std::uint32_t size = magnitude(coded);
        level.L(v, k) = static_cast<std::uint8_t>(std::min(size, 255u));
        own += 0.3 * (size - own);
        usual += 0.01 * (size - usual);
    }

    static Places some_of(const std::array<std::uint32_t, 3>& all)
    {
        Places places;
        std::copy_n(all.begin(), contexts, places.begin());
        return places;
    }

    /// The levels of the three nearest vertices and of the two components before, each 0, 1 or more.
    static std::uint32_t seen(const Interpolation::Weights& near, const Place& place, MatrixView<const std::uint8_t> L)
    {
        const auto third = [](std::uint32_t size) { return std::min(size, 2u); };
        std::uint32_t context = third(L(place.v, place.k - 1)) * 3 + third(place.k > 1 ? L(place.v, place.k - 2) : 0);
        for (std::size_t i = 0; i < 3; ++i)
            context = context * 3 + (i < near.count ? third(L(near.vertices[i], place.k)) : 0);
        return context;
    }

    Core& core_;
    const Interpolation& interpolation_;
    Taper taper_;
    LengthGuess* lengths_;
    coding::MixedLevels<contexts> levels_;
    std::vector<double> usual_;          ///< [K] how large the levels of a component have been of late
    std::vector<double> own_;            ///< [W] and those of a vertex
    std::vector<double> guess_, nearby_; ///< of a batch
};

} // namespace meshreel::codecs
