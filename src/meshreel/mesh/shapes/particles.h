/// Position-based dynamics: particles, distance constraints, and the obstacles they fall on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshreel/mesh/shapes/vec.h"

namespace meshreel::shapes {

/// Keeps two particles `rest` apart.
struct Link {
    std::uint32_t a, b;
    double rest;
    double compliance; ///< 0: rigid; metres a newton: softer
};

/// Keeps a weighted sum of four particles at zero: with the weights of two flat triangles at an edge, keeps them flat.
struct Hinge {
    std::array<std::uint32_t, 4> at;
    std::array<double, 4> weight; ///< sums to 0
    double compliance;
};

/// The ground y = 0, a ball, and a ring lying around it. Sizes of 0: not there.
struct Obstacles {
    Vec ball_centre{0, 0, 0};
    double ball_radius = 0.0;
    double ring_radius = 0.0, ring_thickness = 0.0; ///< a torus about the y axis, lying on the ground
};

/// Particles of mass 1. One step: predict, satisfy the links one after another, collide, and take the velocities from
/// the change of position.
/// @source Müller, Heidelberger, Hennix, Ratcliff: Position Based Dynamics, 2007; compliance: Macklin et al., XPBD, 2016
class Particles {
public:
    struct Settings {
        double gravity = 9.81;  ///< units a second squared, downwards
        double damping = 0.0;   ///< share of the velocity lost in a second
        double friction = 0.5;  ///< of obstacles: share of the sliding speed lost at a touch, in one step
        double skin = 0.0;      ///< distance kept from obstacles
        double thickness = 0.0; ///< distance kept between particles that are further apart at rest; 0: none
    };

    Particles(std::vector<Vec> points, std::vector<Link> links, const Obstacles& obstacles, const Settings& settings);
    void add_hinges(std::vector<Hinge> hinges) { hinges_ = std::move(hinges); }

    void step(double dt);

    std::vector<Vec> position, velocity; ///< may be changed between steps

private:
    /// Two particles that were near each other lately.
    struct Near {
        std::uint32_t a, b;
    };

    void satisfy_links(double dt);
    void satisfy_hinges(double dt);
    void keep_apart();
    void repel(Near pair);
    void collide();
    void find_near();

    std::vector<Vec> rest_, previous_;
    std::vector<Link> links_;
    std::vector<Hinge> hinges_;
    Obstacles obstacles_;
    Settings settings_;
    std::vector<Near> near_;
    std::uint64_t steps_ = 0; ///< odd steps satisfy the links backwards, so that neither end is favoured
};

} // namespace meshreel::shapes
