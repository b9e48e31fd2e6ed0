/// A fish: waves run down its body while it swims along a curve.
// SPDX-License-Identifier: MIT
#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes/makers.h"
#include "meshreel/mesh/shapes/tube.h"

namespace meshreel::shapes {

namespace {

constexpr double swim_speed = 0.8; // body lengths a second; the body is 1 long

struct Section {
    double half_height, half_width;
};

/// The body narrows to the root of the tail, from which a thin, high fin grows.
Section section(double s)
{
    if (s <= 0.0 || s >= 1.0) return {0.0, 0.0};
    const double u = s < 0.84 ? s / 0.84 : 1.0;
    const double bulk = std::sqrt(u) * (1.0 - u) * 2.6, root = u < 0.125 ? 8.0 * u : 1.0;
    const double fin = smooth_step(0.84, 0.99, s);
    return {0.13 * bulk + 0.022 * root + 0.15 * fin, 0.075 * bulk + 0.012 * root * (1.0 - 0.8 * fin)};
}

Vec swimmer_at_rest(double s, double turn)
{
    const Section here = section(s);
    const double c = exact::cos(2.0 * pi * turn), h = exact::sin(2.0 * pi * turn);
    double up = here.half_height * h;
    const double h4 = h * h * h * h;
    if (h > 0.0) up += 0.09 * h4 * h4 * smooth_step(0.28, 0.42, s) * (1.0 - smooth_step(0.45, 0.66, s)); // dorsal fin
    if (h < 0.0) up -= 0.05 * h4 * h4 * smooth_step(0.52, 0.60, s) * (1.0 - smooth_step(0.62, 0.72, s)); // anal fin
    const double fork = 0.12 * smooth_step(0.88, 1.0, s) * h * h;
    return {s + fork, up, here.half_width * c};
}

} // namespace

Animation swimmer(const ShapeOptions& options)
{
    const Body body = tube(options.vertices, 0.55, swimmer_at_rest);
    Animation animation = animation_of(body, options);
    animation.meta.name = "swimmer";
    animation.meta.up = Axis::y;

    Random random(options.seed);
    const double phase = random.uniform(0.0, 2.0 * pi), bend = random.uniform(0.3, 0.6),
                 beat = random.uniform(1.2, 1.6);
    const Path path([=](double u) { return bend * u + 0.5 * exact::sin(0.8 * u + phase); }, -1.3,
                    swim_speed * animation.times_s.back());
    for (std::size_t f = 0; f < options.frames; ++f) {
        const std::span<float> out = animation.frame(f);
        const double t = animation.times_s[f], rise = 0.08 * exact::sin(1.1 * t + phase);
        for (std::size_t v = 0; v < body.points.size(); ++v) {
            const auto& [s, up, side] = body.points[v];
            const double amplitude = 0.015 + 0.11 * s * s, wave = 2.0 * pi * (1.1 * s - beat * t);
            const double sway = amplitude * exact::sin(wave);
            const double slope = 0.22 * s * exact::sin(wave) + amplitude * 2.2 * pi * exact::cos(wave); // d sway / d s
            const Path::Place place = path.at(swim_speed * t - s);
            // Across the bent axis, not across the path.
            const Vec across = (1.0 / std::sqrt(1.0 + slope * slope)) * (place.side + slope * place.forward);
            const Vec point = place.position + sway * place.side + side * across;
            out[3 * v] = static_cast<float>(point[0]);
            out[3 * v + 1] = static_cast<float>(up + rise);
            out[3 * v + 2] = static_cast<float>(point[2]);
        }
    }
    return animation;
}

} // namespace meshreel::shapes
