/// The encoder's choice of what goes.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/decimated.h"

#include <cmath>

namespace meshreel::codecs {

Removals removals(const connectivity::Surface& surface, const connectivity::Plan& plan)
{
    Removals all;
    all.levels = plan.levels;
    all.decimation =
        connectivity::decimate(surface, plan.levels, [&](std::uint32_t level, std::uint32_t v, std::uint32_t context) {
            all.answers.push_back({context, plan.level[v] == level});
            return all.answers.back().goes;
        });
    return all;
}

RemovalJudge::RemovalJudge(MatrixView<const float> C) : C_(C)
{
    constexpr double precision = 0.001, truncation = 0.65;
    std::vector<double> squares(C.cols);
    double sum = 0;
    for (std::size_t v = 0; v < C.rows; ++v)
        for (std::size_t k = 0; k < C.cols; ++k) squares[k] += static_cast<double>(C(v, k)) * C(v, k);
    for (double square : squares) sum += square;
    const double W = static_cast<double>(C.rows);
    if (sum > 0) step_ = precision * std::sqrt(sum / W);
    const double least = truncation * truncation * step_ * step_ * W;
    components_ = static_cast<std::size_t>(
        std::count_if(squares.begin(), squares.end(), [&](double square) { return square >= least; }));
}

coding::Contexts decimated_contexts(Entropy entropy, std::size_t bases)
{
    const std::uint32_t answers = entropy == Entropy::range ? connectivity::removal_contexts : 1;
    return {grid_of(entropy).size(2 * static_cast<std::uint32_t>(bases)), std::vector<std::uint32_t>(answers, 2)};
}

} // namespace meshreel::codecs
