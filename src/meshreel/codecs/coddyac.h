/// Coddyac: connectivity driven dynamic mesh compression (thesis 8.1, its basis by 8.4 and 8.5).
// SPDX-License-Identifier: MIT
#pragma once

#include "meshreel/base/views.h"
#include "meshreel/codecs/codec.h"
#include "meshreel/codecs/contexts.h"
#include "meshreel/coding/quantiser.h"
#include "meshreel/predict/parallelogram.h"

namespace meshreel::codecs {

/// The registry's row.
Codec coddyac();

/// Codes the residuals of all vertices in traversal order; afterwards C holds what the decoder will see, bit for bit.
/// gates: [W], where each vertex was met. C [W x K], model units; writing: originals in, reading: anything in.
/// levels: [W + 1 x K], all zero; row v: what was coded for vertex v, the last row: of no vertex.
/// Level contexts: K rows of the grid.
/// @cost O(W K).  @source thesis 8.1.3, (8.1)
template <class Coder>
class ResidualWalk {
public:
    ResidualWalk(Coder& coder, ContextGrid grid, coding::Quantiser quantiser, MatrixView<std::int32_t> levels)
        : coder_(coder), grid_(grid), quantiser_(quantiser), levels_(levels)
    {
    }

    void code(std::span<const connectivity::Gate> gates, MatrixView<double> C)
    {
        guess_.assign(C.cols, 0.0);
        for (std::size_t v = 0; v < C.rows; ++v) {
            predict(gates[v], v, C);
            code_vertex(gates[v], v, C.row(v));
            if (ended(coder_)) return;
        }
    }

private:
    /// The parallelogram, or as much of it as is there: a middle, a neighbour, the vertex before.
    void predict(const connectivity::Gate& gate, std::size_t v, MatrixView<double> C)
    {
        const auto copy = [&](std::size_t from) { std::copy_n(C.row(from).data(), C.cols, guess_.data()); };
        if (gate.left.valid() && gate.right.valid() && gate.opposite.valid()) {
            predict::parallelogram(C.row(gate.left.value), C.row(gate.right.value), C.row(gate.opposite.value), guess_);
        } else if (gate.left.valid() && gate.right.valid()) {
            for (std::size_t k = 0; k < C.cols; ++k) guess_[k] = 0.5 * (C(gate.left.value, k) + C(gate.right.value, k));
        } else if (gate.left.valid() || gate.right.valid()) {
            copy(gate.left.valid() ? gate.left.value : gate.right.value);
        } else if (v > 0) {
            copy(v - 1);
        }
    }

    void code_vertex(const connectivity::Gate& gate, std::size_t v, std::span<double> row)
    {
        const std::span<const std::int32_t> left = levels_of(gate.left), right = levels_of(gate.right),
                                            opposite = levels_of(gate.opposite);
        const std::span<std::int32_t> levels = levels_.row(v);
        std::uint32_t own = 0; // what this vertex' components so far were off by, the latest most
        for (std::size_t k = 0; k < row.size(); ++k) {
            const std::uint32_t nearby = magnitude(left[k]) + magnitude(right[k]) + magnitude(opposite[k]) + own;
            const std::int32_t wanted = Coder::writes ? quantiser_.level(row[k] - guess_[k]) : 0;
            levels[k] = coder_.level(grid_.index(static_cast<std::uint32_t>(k), nearby), wanted);
            row[k] = guess_[k] + quantiser_.value(levels[k]);
            own = (own + 2 * magnitude(levels[k])) / 2;
        }
    }

    std::span<const std::int32_t> levels_of(VertexId vertex) const
    {
        return levels_.row(vertex.valid() ? vertex.value : levels_.rows - 1);
    }

    Coder& coder_;
    ContextGrid grid_;
    coding::Quantiser quantiser_;
    MatrixView<std::int32_t> levels_;
    std::vector<double> guess_;
};

} // namespace meshreel::codecs
