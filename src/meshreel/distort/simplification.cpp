/// A prefix of an order from coarse to fine, and the coarse surface over it.
// SPDX-License-Identifier: MIT
#include "meshreel/distort/simplification.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/views.h"
#include "meshreel/mesh/coarse_to_fine.h"
#include "meshreel/mesh/reorder.h"
#include "meshreel/mesh/surface_part.h"
#include "meshreel/mesh/weld.h"

namespace meshreel::distort {

Result<Animation> simplification(const Animation& animation, const Request& request)
{
    const Weld welded = weld(animation, request.threads);
    const std::uint32_t W = welded.unique_count();
    Matrix<double> places(W, 3);
    for (std::uint32_t w = 0; w < W; ++w)
        std::copy_n(animation.frame(0).data() + 3ul * welded.first_of[w], 3, places.row(w).data());
    const CoarseToFine spread = coarse_to_fine(places.view(), 1, request.threads);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(request.amount * W)));
    const SurfacePart part = surface_part({W, animation.triangles, welded.unique_of}, animation.appearance,
                                          places.view(), std::span(spread.order).first(count));
    Animation result;
    result.vertex_count = static_cast<std::uint32_t>(part.vertex_of.size());
    result.triangles = part.triangles;
    result.times_s = animation.times_s;
    result.meta = animation.meta;
    result.appearance = appearance_of(part, animation.appearance);
    result.positions.resize(result.frame_count() * result.vertex_count * 3);
    for (std::size_t f = 0; f < result.frame_count(); ++f)
        reorder_frame(animation.frame(f), part.vertex_of, result.frame(f));
    return result;
}

} // namespace meshreel::distort
