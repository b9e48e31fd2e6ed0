/// Combined compression and simplification: the coarsest mesh by Coddyac, the rest by a predictor among its neighbours.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <vector>

#include "meshreel/codecs/coddyac.h"
#include "meshreel/codecs/entropy.h"
#include "meshreel/codecs/pca_codec.h"
#include "meshreel/codecs/refinement.h"
#include "meshreel/connectivity/decimation.h"
#include "meshreel/connectivity/decimation_plan.h"

namespace meshreel::codecs {

/// A decimation and the answers that make it: what is sent of it.
struct Removals {
    struct Answer {
        std::uint32_t context;
        bool goes;
    };
    int levels = 0;
    std::vector<Answer> answers;
    connectivity::Decimation decimation;
};

/// What decimate() asks and a plan answers.
Removals removals(const connectivity::Surface& surface, const connectivity::Plan& plan);

/// How well a vertex is predicted from its ring, on unquantised coefficients; the smaller the better.
/// The components that are judged, and the step that predictors are told, are those that a KG error of about 0.2 %
/// would need: the plan must not depend on what is asked for.
class RemovalJudge {
public:
    explicit RemovalJudge(MatrixView<const float> C);

    /// The prediction error: the sum of what is missed of each component, which is what residuals cost.
    template <class Predictor>
    double cost(Predictor& predictor, std::uint32_t v, std::span<const std::uint32_t> ring)
    {
        predictor.start(ring.size());
        double error = 0;
        for (std::size_t k = components_; k-- > 0;) {
            for (std::size_t i = 0; i < ring.size(); ++i) y_[i] = C_(ring[i], k);
            const std::span<const double> y = std::span(y_).first(ring.size());
            const double value = C_(v, k), miss = predictor.guess(y) - value;
            predictor.learn(y, value);
            error += miss < 0 ? -miss : miss;
        }
        return error;
    }

    double step() const { return step_; }

private:
    MatrixView<const float> C_;
    std::size_t components_ = 0;
    double step_ = 1.0;
    std::array<double, connectivity::largest_ring> y_{};
};

/// Contexts of levels (coarsest mesh, then refinement, a row a component each) and of answers.
coding::Contexts decimated_contexts(Entropy entropy, std::size_t bases);

/// Codes the number of levels and the answers; a reader decimates the surface by them.
/// DEVIATES (8.2): at each level whether a vertex goes, of those that still may; not the level of every vertex.
template <class Coder>
void code_removals(Coder& coder, Entropy entropy, const connectivity::Surface& surface,
                   std::conditional_t<Coder::writes, const Removals, Removals>& all)
{
    const std::uint32_t contexts = entropy == Entropy::range ? connectivity::removal_contexts : 1;
    const auto code = [&](std::uint32_t context, bool goes) {
        return coder.symbol(std::min(context, contexts - 1), goes ? 1 : 0) != 0;
    };
    const int levels = coder.bits(all.levels, 5);
    if constexpr (Coder::writes) {
        for (const Removals::Answer& answer : all.answers) code(answer.context, answer.goes);
    } else {
        const auto goes = [&](std::uint32_t, std::uint32_t, std::uint32_t context) { return code(context, false); };
        all.decimation = connectivity::decimate(surface, levels, goes);
    }
}

/// Codes everything about the coefficients C [W x K], in the surface's order.
template <class Predictor, class Coder>
void code_decimated(Coder& coder, const PcaPayload& head, const connectivity::Decimation& decimation,
                    MatrixView<double> C)
{
    Matrix<double> rows(C.rows, C.cols);
    Matrix<std::int32_t> levels(C.rows + 1, C.cols);
    for (std::size_t i = 0; Coder::writes && i < C.rows; ++i)
        std::copy_n(C.row(decimation.vertex_of[i]).data(), C.cols, rows.row(i).data());
    const ContextGrid grid = grid_of(head.entropy);
    const MatrixView<double> coarse{rows.values.data(), decimation.coarse_count(), C.cols};
    ResidualWalk(coder, grid, {head.step}, levels.view()).code(decimation.gates, coarse);
    RefinementWalk<Coder, Predictor>(coder, grid, {head.step}, levels.view()).code(decimation, rows.view());
    for (std::size_t i = 0; i < C.rows; ++i)
        std::copy_n(rows.row(i).data(), C.cols, C.row(decimation.vertex_of[i]).data());
}

template <class Predictor>
class DecimatedWriter : public ResidualWriter {
public:
    DecimatedWriter(const Sequence& sequence, MatrixView<const float> C) : surface_(sequence.surface)
    {
        RemovalJudge judge(C);
        Predictor predictor(judge.step());
        const auto cost = [&](std::uint32_t v, std::span<const std::uint32_t> ring) {
            return judge.cost(predictor, v, ring);
        };
        all_ = removals(surface_, connectivity::plan_decimation(surface_, sequence.frames.row(0), cost));
        none_ = removals(surface_, {});
    }

    /// With all levels, or with none where that is smaller: a predictor may be worse than the parallelogram.
    Bytes write(const PcaPayload& head, MatrixView<double> C) const override
    {
        Matrix<double> plain(C.rows, C.cols);
        std::copy_n(C.data, plain.values.size(), plain.values.begin());
        Bytes bytes = write_with(all_, head, C), undecimated = write_with(none_, head, plain.view());
        if (bytes.size() <= undecimated.size()) return bytes;
        std::copy(plain.values.begin(), plain.values.end(), C.data);
        return undecimated;
    }

private:
    Bytes write_with(const Removals& removals, const PcaPayload& head, MatrixView<double> C) const
    {
        return written(head.entropy, decimated_contexts(head.entropy, C.cols), [&](auto& coder) {
            code_removals(coder, head.entropy, surface_, removals);
            code_decimated<Predictor>(coder, head, removals.decimation, C);
        });
    }

    const connectivity::Surface& surface_;
    Removals all_, none_;
};

template <class Predictor>
std::unique_ptr<ResidualWriter> study_decimated(const Sequence& sequence, MatrixView<const float> C)
{
    return std::make_unique<DecimatedWriter<Predictor>>(sequence, C);
}

template <class Predictor>
Status read_decimated(const PcaPayload& head, const Coded& coded, MatrixView<double> C)
{
    const std::uint64_t W = C.rows, K = C.cols;
    const std::uint64_t needed = connectivity::decimation_bytes(coded.surface) + 12 * K * (W + 1);
    if (needed > coded.limits.max_memory) return bad_input("the decimation does not fit in the memory limit");
    return taken(head.entropy, head.residual_bits, decimated_contexts(head.entropy, K), [&](auto& coder) {
        Removals all;
        code_removals(coder, head.entropy, coded.surface, all);
        if (!coder.overrun()) code_decimated<Predictor>(coder, head, all.decimation, C);
    });
}

} // namespace meshreel::codecs
