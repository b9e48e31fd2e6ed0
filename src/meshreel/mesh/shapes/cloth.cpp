/// A square of cloth that falls on a ball, a ring and the ground.
// SPDX-License-Identifier: MIT
#include "meshreel/base/random.h"
#include "meshreel/mesh/corner_table.h"
#include "meshreel/mesh/shapes/body.h"
#include "meshreel/mesh/shapes/makers.h"
#include "meshreel/mesh/shapes/particles.h"

namespace meshreel::shapes {

namespace {

constexpr double width = 2.4;         ///< of the cloth, in units
constexpr double bending = 25.0;      ///< compliance of the hinges / spacing^4, which makes a cloth of one stiffness
constexpr double cloth_step = 0.0025; ///< seconds

/// Stretch along every edge.
std::vector<Link> links_of(const Body& body, const CornerTable& table)
{
    std::vector<Link> links;
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const auto [low, high, corners, kind] = table.edge(e);
        links.push_back({low.value, high.value, length(body.points[high.value] - body.points[low.value]), 0.0});
    }
    return links;
}

/// The cotangent of the angle at a corner.
double cotangent(const Body& body, const CornerTable& table, CornerId c)
{
    const auto point = [&](CornerId at) { return body.points[table.vertex(at).value]; };
    const Vec a = point(next(c)) - point(c), b = point(previous(c)) - point(c);
    const double cosine = dot(a, b);
    return cosine / std::sqrt(dot(a, a) * dot(b, b) - cosine * cosine);
}

/// Bending across every interior edge. Müller's constraint takes the angle between the triangles, whose arccos is no
/// part of exact arithmetic; this is the isometric bending energy of Bergou et al. 2006, linear in the positions.
std::vector<Hinge> hinges_of(const Body& body, const CornerTable& table, double compliance)
{
    std::vector<Hinge> hinges;
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const Edge edge = table.edge(e);
        if (edge.kind != EdgeKind::interior) continue;
        const CornerId c = edge.corners[0], o = edge.corners[1];
        const CornerId c_from = next(c), c_to = previous(c), o_from = previous(o),
                       o_to = next(o); // o_from lies on c_from
        const double from_c = cotangent(body, table, c_from), from_o = cotangent(body, table, o_from);
        const double to_c = cotangent(body, table, c_to), to_o = cotangent(body, table, o_to);
        hinges.push_back(
            {{table.vertex(c_from).value, table.vertex(c_to).value, table.vertex(c).value, table.vertex(o).value},
             {to_c + to_o, from_c + from_o, -from_c - to_c, -from_o - to_o},
             compliance});
    }
    return hinges;
}

/// Lays the sheet level above the obstacles, turned and ruffled by the seed.
std::vector<Vec> hung(const Body& body, std::uint64_t seed)
{
    Random random(seed);
    const double slope = random.uniform(0.1, 0.5), scale = 1.0 / std::sqrt(1.0 + slope * slope);
    const double shift_x = random.uniform(-0.15, 0.15), shift_z = random.uniform(-0.15, 0.15);
    std::vector<Vec> points;
    for (const Vec& p : body.points) {
        const double x = p[0] - 0.5 * width, z = 0.5 * width - p[1];
        const double ruffle = random.uniform(-0.0005, 0.0005);
        points.push_back(
            {scale * (x - slope * z) + shift_x, 1.45 + ruffle + 0.06 * x, scale * (slope * x + z) + shift_z});
    }
    return points;
}

} // namespace

Animation cloth(const ShapeOptions& options)
{
    Body body = grid(grid_size(options.vertices, width, width));
    split_edges(body, options.vertices);
    Animation animation = animation_of(body, options);
    animation.meta.name = "cloth";
    animation.meta.up = Axis::y;

    const double spacing = width / std::sqrt(static_cast<double>(options.vertices));
    const Obstacles obstacles{{0.0, 0.75, 0.0}, 0.5, 0.95, 0.16};
    Particles::Settings settings;
    settings.damping = 1.0;
    settings.friction = 0.5;
    settings.skin = 0.4 * spacing;
    settings.thickness = 0.9 * spacing;
    const CornerTable table(options.vertices, body.triangles);
    Particles particles(hung(body, options.seed), links_of(body, table), obstacles, settings);
    particles.add_hinges(hinges_of(body, table, bending * spacing * spacing * spacing * spacing));

    const double frame_time = 1.0 / options.fps;
    const auto steps = static_cast<std::size_t>(frame_time / cloth_step) + 1;
    for (std::size_t f = 0; f < options.frames; ++f) {
        for (std::size_t s = 0; f > 0 && s < steps; ++s) particles.step(frame_time / static_cast<double>(steps));
        std::span<float> out = animation.frame(f);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(particles.position[i / 3][i % 3]);
    }
    return animation;
}

} // namespace meshreel::shapes
