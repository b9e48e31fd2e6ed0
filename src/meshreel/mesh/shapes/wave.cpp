/// A standing wave on a square sheet: one spatial mode times one function of time.
// SPDX-License-Identifier: MIT
#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes/body.h"
#include "meshreel/mesh/shapes/makers.h"
#include "meshreel/mesh/shapes/vec.h"

namespace meshreel::shapes {

namespace {

/// The multiple of 2^-11 nearest to x. Two such numbers of at most 1 have a product that float32 holds exactly.
double coarse(double x)
{
    return static_cast<double>(exact::round(x * 2048.0)) / 2048.0;
}

} // namespace

/// z(v, t) = mode(v) sin(2 pi t) / 4, mode and sine rounded so that the products are exact in float32: whatever is
/// subtracted as a mean, the motion has rank 1 to the last bit.
Animation wave(const ShapeOptions& options)
{
    Body body = grid(grid_size(options.vertices, 1.0, 1.0));
    split_edges(body, options.vertices);
    Animation animation = animation_of(body, options);
    animation.meta.name = "wave";
    animation.meta.up = Axis::z;

    Random random(options.seed);
    const double across = static_cast<double>(1 + random.below(3)), along = static_cast<double>(1 + random.below(3));
    const double phase = random.uniform(0.0, 2.0 * pi);
    for (std::size_t f = 0; f < options.frames; ++f) {
        const double swing = coarse(exact::sin(2.0 * pi * animation.times_s[f]));
        const std::span<float> out = animation.frame(f);
        for (std::size_t v = 0; v < body.points.size(); ++v) {
            const auto& [x, y, z] = body.points[v];
            const double mode = coarse(exact::sin(2.0 * pi * across * x + phase) * exact::cos(pi * along * y));
            out[3 * v] = static_cast<float>(x);
            out[3 * v + 1] = static_cast<float>(y);
            out[3 * v + 2] = static_cast<float>(0.25 * mode * swing);
        }
    }
    return animation;
}

} // namespace meshreel::shapes
