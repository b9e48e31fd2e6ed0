/// Steps towards the mean of the neighbours, or away from it.
// SPDX-License-Identifier: MIT
#include "meshreel/distort/smoothing.h"

#include <algorithm>
#include <array>
#include <vector>

#include "meshreel/base/views.h"
#include "meshreel/mesh/corner_table.h"
#include "meshreel/mesh/weld.h"

namespace meshreel::distort {

namespace {

constexpr std::array laplacian_steps{0.5};
constexpr std::array taubin_steps{0.5, -0.53}; // lambda, mu

/// The edges of a surface whose doubled vertices are one, each once.
struct SmoothedSurface {
    explicit SmoothedSurface(const Animation& animation, Threads threads) : welded(weld(animation, threads))
    {
        triangles = animation.triangles;
        for (Triangle& t : triangles)
            for (std::uint32_t& v : t) v = welded.unique_of[v];
        const CornerTable table(welded.unique_count(), triangles);
        valence.resize(welded.unique_count());
        for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
            edges.push_back({table.edge(e).low.value, table.edge(e).high.value});
            for (const std::uint32_t v : edges.back()) valence[v] += 1.0;
        }
    }

    Weld welded;
    std::vector<Triangle> triangles;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<double> valence; ///< neighbours of each vertex
};

/// p += step (mean of the neighbours - p), all vertices at once. frame: [3W]; sum: scratch of that size.
void smooth_once(const SmoothedSurface& surface, double step, std::span<double> frame, std::span<double> sum)
{
    std::fill(sum.begin(), sum.end(), 0.0);
    for (const auto& [a, b] : surface.edges)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sum[3ul * a + axis] += frame[3ul * b + axis];
            sum[3ul * b + axis] += frame[3ul * a + axis];
        }
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (surface.valence[i / 3] > 0) frame[i] += step * (sum[i] / surface.valence[i / 3] - frame[i]);
}

Animation smoothed(const Animation& animation, const Request& request, std::span<const double> steps)
{
    const SmoothedSurface surface(animation, request.threads);
    const auto times = static_cast<std::size_t>(request.amount);
    Animation result = animation;
    parallel_for(animation.frame_count(), request.threads, [&](std::size_t f) {
        std::vector<double> frame, sum(3ul * surface.welded.unique_count());
        for (const std::uint32_t v : surface.welded.first_of)
            for (std::size_t axis = 0; axis < 3; ++axis) frame.push_back(animation.frame(f)[3ul * v + axis]);
        for (std::size_t i = 0; i < times * steps.size(); ++i)
            smooth_once(surface, steps[i % steps.size()], frame, sum);
        const std::span<float> out = result.frame(f);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = static_cast<float>(frame[3ul * surface.welded.unique_of[i / 3] + i % 3]);
    });
    return result;
}

} // namespace

Result<Animation> laplacian_smoothing(const Animation& animation, const Request& request)
{
    return smoothed(animation, request, laplacian_steps);
}

Result<Animation> taubin_smoothing(const Animation& animation, const Request& request)
{
    return smoothed(animation, request, taubin_steps);
}

} // namespace meshreel::distort
