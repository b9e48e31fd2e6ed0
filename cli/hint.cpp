/// The edit distance in which swapping two neighbouring letters is one slip (optimal string alignment).
// SPDX-License-Identifier: MIT
#include "cli/hint.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meshreel::cli {

namespace {

std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

} // namespace

std::string nearest(std::string_view written, std::span<const std::string> candidates)
{
    std::string best;
    std::size_t best_distance = std::min<std::size_t>(3, std::max<std::size_t>(1, written.size() / 3)) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t far = distance(written, candidate);
        if (far >= best_distance) continue;
        best = candidate;
        best_distance = far;
    }
    return best;
}

} // namespace meshreel::cli
