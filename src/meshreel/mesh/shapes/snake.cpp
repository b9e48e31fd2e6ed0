/// A snake: a tube that follows its own winding track.
// SPDX-License-Identifier: MIT
#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes/makers.h"
#include "meshreel/mesh/shapes/tube.h"

namespace meshreel::shapes {

namespace {

constexpr double body_length = 6.0, crawl_speed = 1.5; // lengths in units, units a second

/// Half the thickness along the body: a rounded head, a neck, a belly, a thin tail.
double thickness(double s)
{
    const double head = 0.045 * smooth_step(0.0, 0.03, s) * (1.0 - smooth_step(0.05, 0.10, s));
    const double belly = 0.13 * (0.55 + 0.45 * smooth_step(0.08, 0.35, s));
    const double nose = std::sqrt(smooth_step(-0.02, 0.05, s)), tail = 1.0 - smooth_step(0.5, 1.02, s);
    return (head + belly) * (s == 0.0 ? 0.0 : nose) * tail + (s == 0.0 || s == 1.0 ? 0.0 : 0.004);
}

Vec snake_at_rest(double s, double turn)
{
    const double r = thickness(s), c = exact::cos(2.0 * pi * turn), h = exact::sin(2.0 * pi * turn);
    const double flat = h < 0.0 ? 0.6 : 0.85; // a flat belly
    return {s, 0.14 + flat * r * h, r * c};
}

} // namespace

Animation snake(const ShapeOptions& options)
{
    const Body body = tube(options.vertices, 0.13, snake_at_rest);
    Animation animation = animation_of(body, options);
    animation.meta.name = "snake";
    animation.meta.up = Axis::y;

    Random random(options.seed);
    const double phase = random.uniform(0.0, 2.0 * pi), drift = random.uniform(0.25, 0.4),
                 sway = random.uniform(0.9, 1.1);
    const auto heading = [=](double u) {
        return sway * exact::sin(2.2 * u + phase) + drift * exact::sin(0.31 * u + 2.0 * phase);
    };
    const Path path(heading, -body_length, crawl_speed * animation.times_s.back());
    for (std::size_t f = 0; f < options.frames; ++f) {
        const std::span<float> out = animation.frame(f);
        const double travelled = crawl_speed * animation.times_s[f];
        for (std::size_t v = 0; v < body.points.size(); ++v) {
            const auto& [s, up, side] = body.points[v];
            const Path::Place place = path.at(travelled - s * body_length);
            // The head is held up and looks about.
            const double raised =
                0.25 * (1.0 - smooth_step(0.02, 0.2, s)) * (1.0 + 0.3 * exact::sin(3.0 * animation.times_s[f]));
            const Vec point = place.position + side * place.side;
            out[3 * v] = static_cast<float>(point[0]);
            out[3 * v + 1] = static_cast<float>(up + raised);
            out[3 * v + 2] = static_cast<float>(point[2]);
        }
    }
    return animation;
}

} // namespace meshreel::shapes
