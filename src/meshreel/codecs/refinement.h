/// Vertices put back one by one: each predicted from its neighbours, component after component.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/codecs/contexts.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/connectivity/decimation.h"

namespace meshreel::codecs {

/// What a predictor is asked for: start(neighbours), then for each component guess(y) and learn(y, value).
/// Codes the residuals of all rows below the coarsest mesh, the last component first, as it is the smallest; afterwards
/// C holds what the decoder will see, bit for bit.
/// C [W x K], model units, by rows of the decimation; those of the coarsest mesh as decoded. levels: [W + 1 x K]; row
/// v: what was coded for row v. Level contexts: rows K .. 2K - 1 of the grid.
/// @cost O(W K) guesses.  @source thesis 8.2, 8.3
template <class Coder, class Predictor>
class RefinementWalk {
public:
    RefinementWalk(Coder& coder, ContextGrid grid, coding::Quantiser quantiser, MatrixView<std::int32_t> levels)
        : coder_(coder), grid_(grid), quantiser_(quantiser), levels_(levels), predictor_(quantiser.step)
    {
    }

    void code(const connectivity::Decimation& decimation, MatrixView<double> C)
    {
        for (std::uint32_t row = decimation.coarse_count(); row < C.rows && !ended(coder_); ++row)
            code_vertex(decimation.ring(row), levels_.row(row), C, row);
    }

private:
    void code_vertex(std::span<const std::uint32_t> ring, std::span<std::int32_t> levels, MatrixView<double> C,
                     std::uint32_t row)
    {
        predictor_.start(ring.size());
        std::uint32_t own = 0; // what this vertex' components so far were off by, the latest most
        for (std::size_t k = C.cols; k-- > 0;) {
            std::uint32_t around = 0;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                y_[i] = C(ring[i], k);
                around += magnitude(levels_(ring[i], k));
            }
            const std::uint32_t nearby = 3 * around / static_cast<std::uint32_t>(ring.size()) + own;
            const std::span<const double> y = std::span(y_).first(ring.size());
            const double guess = predictor_.guess(y);
            const std::int32_t wanted = Coder::writes ? quantiser_.level(C(row, k) - guess) : 0;
            levels[k] = coder_.level(grid_.index(static_cast<std::uint32_t>(C.cols + k), nearby), wanted);
            C(row, k) = guess + quantiser_.value(levels[k]);
            predictor_.learn(y, C(row, k));
            own = (own + 2 * magnitude(levels[k])) / 2;
        }
    }

    Coder& coder_;
    ContextGrid grid_;
    coding::Quantiser quantiser_;
    MatrixView<std::int32_t> levels_;
    Predictor predictor_;
    std::array<double, connectivity::largest_ring> y_;
};

} // namespace meshreel::codecs
