/// Every vertex' neighbours, told apart by whether a walk along the surface has met them before.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/connectivity/parallelograms.h"
#include "meshreel/connectivity/stars.h"

namespace meshreel::codecs {

/// Neighbours across edges, each once, and the parallelograms that a vertex completes.
class VertexRing {
public:
    /// @cost O(W + T log of the largest degree).
    explicit VertexRing(const connectivity::Surface& surface)
        : parallelograms_(connectivity::parallelograms(surface)), begin_(surface.vertex_count + 1ul, 0),
          split_(surface.vertex_count, 0)
    {
        const connectivity::Stars stars(surface.vertex_count, surface.triangles);
        for (std::uint32_t v = 0; v < surface.vertex_count; ++v) {
            for (const bool later : {false, true}) {
                for (const connectivity::Spoke& spoke : stars.spokes(v))
                    if ((spoke.vertex > v) == later) neighbours_.push_back(spoke.vertex);
                (later ? begin_[v + 1] : split_[v]) = neighbours_.size();
            }
        }
    }

    std::size_t size() const { return split_.size(); }
    std::span<const std::uint32_t> earlier(std::size_t v) const
    {
        return std::span(neighbours_).subspan(begin_[v], split_[v] - begin_[v]);
    }
    std::span<const std::uint32_t> later(std::size_t v) const
    {
        return std::span(neighbours_).subspan(split_[v], begin_[v + 1] - split_[v]);
    }
    std::span<const connectivity::Parallelogram> parallelograms(std::size_t v) const { return parallelograms_.of(v); }

private:
    connectivity::Parallelograms parallelograms_;
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::size_t> begin_, split_; ///< of a vertex' neighbours, and of those that are later
};

} // namespace meshreel::codecs
