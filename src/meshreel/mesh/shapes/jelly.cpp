/// A cube of jelly with rounded edges that falls on the ground, bounces and wobbles.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes/blocks.h"
#include "meshreel/mesh/shapes/makers.h"
#include "meshreel/mesh/shapes/particles.h"

namespace meshreel::shapes {

namespace {

constexpr std::uint32_t cells = 4, nodes = cells + 1; ///< of the elastic lattice, along each axis
constexpr double jelly_step = 0.001;                  ///< seconds
constexpr double softness = 5e-4;                     ///< compliance of the lattice's links

std::uint32_t node(std::uint32_t i, std::uint32_t j, std::uint32_t k)
{
    return (k * nodes + j) * nodes + i;
}

/// Nodes of a unit cube around the origin.
std::vector<Vec> lattice_points()
{
    std::vector<Vec> points;
    for (std::uint32_t n = 0; n < nodes * nodes * nodes; ++n)
        points.push_back({double(n % nodes) / cells - 0.5, double(n / nodes % nodes) / cells - 0.5,
                          double(n / nodes / nodes) / cells - 0.5});
    return points;
}

/// Links between all nodes of each cell: sides and diagonals, each once.
std::vector<Link> lattice_links(const std::vector<Vec>& points)
{
    std::vector<Link> links;
    for (std::uint32_t a = 0; a < points.size(); ++a)
        for (std::uint32_t b = a + 1; b < points.size(); ++b) {
            const Vec apart = points[b] - points[a];
            const bool same_cell =
                std::all_of(apart.begin(), apart.end(), [](double d) { return std::abs(d) < 1.5 / cells; });
            if (same_cell) links.push_back({a, b, length(apart), softness});
        }
    return links;
}

/// Where a point lies in the lattice: four nodes and weights along each axis, Catmull-Rom, so that the surface stays
/// smooth across cells. Beyond the border the lattice goes on in a straight line.
struct Embedding {
    std::array<std::array<double, nodes>, 3> weight{};

    explicit Embedding(const Vec& p)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = (p[axis] + 0.5) * cells;
            const long long cell = std::clamp<long long>(exact::floor(x), 0, cells - 1);
            const double t = x - static_cast<double>(cell), t2 = t * t, t3 = t2 * t;
            add(axis, cell - 1, 0.5 * (-t + 2 * t2 - t3));
            add(axis, cell, 0.5 * (2 - 5 * t2 + 3 * t3));
            add(axis, cell + 1, 0.5 * (t + 4 * t2 - 3 * t3));
            add(axis, cell + 2, 0.5 * (t3 - t2));
        }
    }
    void add(std::size_t axis, long long i, double w)
    {
        if (i < 0) {
            weight[axis][0] += 2 * w;
            weight[axis][1] -= w;
        } else if (i >= nodes) {
            weight[axis][nodes - 1] += 2 * w;
            weight[axis][nodes - 2] -= w;
        } else {
            weight[axis][static_cast<std::size_t>(i)] += w;
        }
    }
    Vec in(const std::vector<Vec>& lattice) const
    {
        Vec sum{};
        for (std::uint32_t k = 0; k < nodes; ++k)
            for (std::uint32_t j = 0; j < nodes; ++j) {
                const double w = weight[2][k] * weight[1][j];
                if (w == 0.0) continue;
                for (std::uint32_t i = 0; i < nodes; ++i) sum = sum + (w * weight[0][i]) * lattice[node(i, j, k)];
            }
        return sum;
    }
};

/// A point of the cube's surface, edges and corners rounded: pulled to a smaller cube, then out again by the radius.
Vec rounded(const Vec& p)
{
    constexpr double radius = 0.14, core = 0.5 - radius;
    Vec inner;
    for (std::size_t i = 0; i < 3; ++i) inner[i] = std::clamp(p[i], -core, core);
    const Vec out = p - inner;
    return inner + (radius / length(out)) * out;
}

/// Lifts the lattice, tilts it and sets it spinning, as the seed says.
void throw_up(Particles& particles, std::uint64_t seed)
{
    Random random(seed);
    const double tilt = random.uniform(0.3, 0.8), c = exact::cos(tilt), s = exact::sin(tilt),
                 spin = random.uniform(0.5, 2.0);
    const double drift = random.uniform(0.2, 0.7);
    for (std::size_t i = 0; i < particles.position.size(); ++i) {
        Vec& p = particles.position[i];
        p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
        p = {p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]};
        particles.velocity[i] = {drift - spin * p[1], spin * p[0], 0.0};
        p[1] += 1.6;
    }
}

} // namespace

Animation jelly(const ShapeOptions& options)
{
    Body body = block_surface({{{{-0.5, 0.5}, {-0.5, 0.5}, {-0.5, 0.5}}}, {{0, 0, 0}}}, options.vertices);
    for (Vec& p : body.points) p = rounded(p);
    Animation animation = animation_of(body, options);
    animation.meta.name = "jelly";
    animation.meta.up = Axis::y;

    const std::vector<Vec> lattice = lattice_points();
    Particles::Settings settings;
    settings.damping = 0.25;
    settings.friction = 0.15;
    Particles particles(lattice, lattice_links(lattice), {}, settings);
    throw_up(particles, options.seed);
    const std::vector<Embedding> embedded(body.points.begin(), body.points.end());

    const double frame_time = 1.0 / options.fps;
    const auto steps = static_cast<std::size_t>(frame_time / jelly_step) + 1;
    for (std::size_t f = 0; f < options.frames; ++f) {
        for (std::size_t s = 0; f > 0 && s < steps; ++s) particles.step(frame_time / static_cast<double>(steps));
        const std::span<float> out = animation.frame(f);
        for (std::size_t v = 0; v < embedded.size(); ++v) {
            const Vec point = embedded[v].in(particles.position);
            for (std::size_t i = 0; i < 3; ++i) out[3 * v + i] = static_cast<float>(point[i]);
        }
    }
    return animation;
}

} // namespace meshreel::shapes
