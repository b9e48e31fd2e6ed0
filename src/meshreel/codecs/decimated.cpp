/// The encoder's choice of what goes.
// SPDX-License-Identifier: MIT
#include "meshreel/codecs/decimated.h"

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

coding::Contexts decimated_contexts(Entropy entropy, std::size_t bases)
{
    const std::uint32_t rows = grid_of(entropy).size(2 * static_cast<std::uint32_t>(bases));
    if (entropy == Entropy::huffman) return {rows, {longest_plain_run + 28}}; // runs below 2^31
    return {rows, std::vector<std::uint32_t>(connectivity::removal_contexts, 2)};
}

} // namespace meshreel::codecs
