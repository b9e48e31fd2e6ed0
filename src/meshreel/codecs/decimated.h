/// Combined compression and simplification: the coarsest mesh by Coddyac, the rest by a predictor among its neighbours.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "meshreel/codecs/coddyac.h"
#include "meshreel/codecs/entropy.h"
#include "meshreel/codecs/pca_codec.h"
#include "meshreel/codecs/refinement.h"
#include "meshreel/codecs/removal_judge.h"
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

constexpr std::uint32_t longest_plain_run = 15;

/// Contexts of levels (coarsest mesh, then refinement, a row a component each) and of answers.
coding::Contexts decimated_contexts(Entropy entropy, std::size_t bases);

/// How many stay before the next that goes, for coders that take a bit at least for a symbol.
template <class Coder>
std::uint32_t code_run(Coder& coder, std::uint32_t run)
{
    const auto plain = static_cast<std::int32_t>(longest_plain_run);
    const int least_width = coding::bit_width(longest_plain_run + 1);
    const std::int32_t wanted =
        run <= longest_plain_run ? static_cast<std::int32_t>(run) : plain + 1 + coding::bit_width(run) - least_width;
    const std::int32_t symbol = coder.symbol(0, wanted);
    if (symbol <= plain) return static_cast<std::uint32_t>(symbol);
    const int below = symbol - plain - 1 + least_width - 1;
    const std::uint32_t top = 1u << below;
    return top | static_cast<std::uint32_t>(coder.bits(static_cast<std::int32_t>(run & (top - 1)), below));
}

/// Writes answers as runs.
template <class Coder>
void write_runs(Coder& coder, std::span<const Removals::Answer> answers)
{
    std::uint32_t run = 0;
    for (const Removals::Answer& answer : answers) {
        if (answer.goes) code_run(coder, run);
        run = answer.goes ? 0 : run + 1;
    }
    if (run > 0) code_run(coder, run);
}

/// Reads what write_runs wrote, an answer at a time.
template <class Coder>
class RunReader {
public:
    explicit RunReader(Coder& coder) : coder_(coder) {}

    bool goes()
    {
        if (!left_) left_ = code_run(coder_, 0);
        if (*left_ > 0) return --*left_, false;
        left_.reset();
        return true;
    }

private:
    Coder& coder_;
    std::optional<std::uint32_t> left_; ///< that stay before the next that goes
};

/// Codes the number of levels and the answers; a reader decimates the surface by them.
/// DEVIATES (8.2): at each level whether a vertex goes, of those that still may; not the level of every vertex.
template <class Coder>
void code_removals(Coder& coder, Entropy entropy, const connectivity::Surface& surface,
                   std::conditional_t<Coder::writes, const Removals, Removals>& all)
{
    const int levels = coder.bits(all.levels, 5);
    const bool runs = entropy == Entropy::huffman;
    if constexpr (Coder::writes) {
        if (runs) return write_runs(coder, all.answers);
        for (const Removals::Answer& answer : all.answers) coder.symbol(answer.context, answer.goes ? 1 : 0);
    } else {
        RunReader reader(coder);
        const auto goes = [&](std::uint32_t, std::uint32_t, std::uint32_t context) {
            return runs ? reader.goes() : coder.symbol(context, 0) != 0;
        };
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
    DecimatedWriter(const Sequence& sequence, MatrixView<const float> C, std::span<const RemovalOrder> orders)
        : surface_(sequence.surface), ways_{removals(surface_, {})}
    {
        RemovalJudge judge(C);
        Predictor predictor(judge.step());
        for (const RemovalOrder order : orders) {
            const bool priced = order == RemovalOrder::price;
            const auto cost = [&](const connectivity::Mesh& mesh, std::uint32_t v, const connectivity::Hole& hole) {
                return priced ? judge.price(predictor, mesh, v, hole) : judge.inaccuracy(predictor, v, hole.ring);
            };
            connectivity::PlanOptions options;
            if (priced) options.dearest = dearest_removal * judge.usual_bits(surface_.gates);
            const auto plan = connectivity::plan_decimation(surface_, sequence.frames.row(0), cost, options);
            ways_.push_back(removals(surface_, plan));
        }
    }

    /// In the way that is smallest; without any levels where even that is larger than Coddyac.
    Bytes write(const PcaPayload& head, MatrixView<double> C) const override
    {
        const std::vector<double> originals(C.data, C.data + C.rows * C.cols);
        std::vector<double> decoded;
        Bytes smallest;
        for (const Removals& way : ways_) {
            std::copy(originals.begin(), originals.end(), C.data);
            Bytes bytes = write_with(way, head, C);
            if (!decoded.empty() && bytes.size() > smallest.size()) continue;
            smallest = std::move(bytes);
            decoded.assign(C.data, C.data + originals.size());
        }
        std::copy(decoded.begin(), decoded.end(), C.data);
        return smallest;
    }

private:
    /// Of what a vertex usually takes: a removal may spoil more parallelograms than it saves and pay at a later level.
    static constexpr double dearest_removal = 0.8;

    Bytes write_with(const Removals& removals, const PcaPayload& head, MatrixView<double> C) const
    {
        return written(head.entropy, decimated_contexts(head.entropy, C.cols), [&](auto& coder) {
            code_removals(coder, head.entropy, surface_, removals);
            code_decimated<Predictor>(coder, head, removals.decimation, C);
        });
    }

    const connectivity::Surface& surface_;
    std::vector<Removals> ways_; ///< the first without levels
};

template <class Predictor, RemovalOrder... orders>
std::unique_ptr<ResidualWriter> study_decimated(const Sequence& sequence, MatrixView<const float> C)
{
    return std::make_unique<DecimatedWriter<Predictor>>(sequence, C, std::array{orders...});
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
