/// Parallelograms from the twins of half-edges, sorted by counting.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/parallelograms.h"

#include <algorithm>

#include "meshreel/connectivity/adjacency.h"

namespace meshreel::connectivity {

Parallelograms parallelograms(const Surface& surface)
{
    const Adjacency mesh = adjacency(surface.vertex_count, surface.triangles);
    const auto each = [&](const auto& body) {
        for (std::uint32_t h = 0; h < mesh.twin.size(); ++h) {
            if (mesh.twin[h] == none) continue;
            const std::uint32_t tip = mesh.from(previous_half(h)), left = mesh.from(h), right = mesh.from(next_half(h)),
                                opposite = mesh.from(previous_half(mesh.twin[h]));
            if (tip > left && tip > right && tip > opposite) body(tip, Parallelogram{left, right, opposite});
        }
    };
    Parallelograms result;
    result.ends.assign(surface.vertex_count, 0);
    each([&](std::uint32_t tip, const Parallelogram&) { ++result.ends[tip]; });
    std::size_t sum = 0;
    for (std::size_t& end : result.ends) {
        const std::size_t here = end;
        end = sum; // where the tip's next one goes; its end in the end
        sum += here;
    }
    result.all.resize(sum);
    each([&](std::uint32_t tip, const Parallelogram& p) { result.all[result.ends[tip]++] = p; });
    return result;
}

} // namespace meshreel::connectivity
