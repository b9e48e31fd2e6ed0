/// Position-based dynamics, in a fixed order of operations.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/shapes/particles.h"

#include <algorithm>
#include <optional>

#include "meshreel/base/exact.h"

namespace meshreel::shapes {

namespace {

/// How deep a point is inside an obstacle, and the way out.
struct Contact {
    double depth;
    Vec normal;
};

std::optional<Contact> ball_contact(const Obstacles& obstacles, const Vec& p, double skin)
{
    if (obstacles.ball_radius == 0.0) return {};
    const Vec out = p - obstacles.ball_centre;
    const double distance = length(out), depth = obstacles.ball_radius + skin - distance;
    if (depth <= 0.0 || distance == 0.0) return {};
    return Contact{depth, (1.0 / distance) * out};
}

std::optional<Contact> ring_contact(const Obstacles& obstacles, const Vec& p, double skin)
{
    if (obstacles.ring_thickness == 0.0) return {};
    const double from_axis = std::sqrt(p[0] * p[0] + p[2] * p[2]);
    if (from_axis == 0.0) return {};
    const double along = obstacles.ring_radius / from_axis;
    const Vec out = p - Vec{p[0] * along, obstacles.ring_thickness, p[2] * along};
    const double distance = length(out), depth = obstacles.ring_thickness + skin - distance;
    if (depth <= 0.0 || distance == 0.0) return {};
    return Contact{depth, (1.0 / distance) * out};
}

std::optional<Contact> ground_contact(const Obstacles&, const Vec& p, double skin)
{
    if (p[1] >= skin) return {};
    return Contact{skin - p[1], {0.0, 1.0, 0.0}};
}

/// Points sorted into the cells of a lattice; cells share 2^k lists by a hash.
class Cells {
public:
    Cells(const std::vector<Vec>& points, double size) : size_(size)
    {
        while (mask_ < 2 * points.size()) mask_ = 2 * mask_ + 1;
        start_.assign(mask_ + 2, 0);
        members_.resize(points.size());
        for (const Vec& p : points) ++start_[list_of(cell_of(p)) + 1];
        for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
        std::vector<std::uint32_t> place(start_.begin(), start_.end() - 1);
        for (std::uint32_t i = 0; i < points.size(); ++i) members_[place[list_of(cell_of(points[i]))]++] = i;
    }

    /// Calls visit(i) for every point in the 27 cells around p, and for some others, in a fixed order.
    template <class Visit>
    void for_each_around(const Vec& p, const Visit& visit) const
    {
        const Cell middle = cell_of(p);
        for (int i = 0; i < 27; ++i) {
            const std::size_t list = list_of({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
            for (std::uint32_t k = start_[list]; k < start_[list + 1]; ++k) visit(members_[k]);
        }
    }

private:
    using Cell = std::array<long long, 3>;

    Cell cell_of(const Vec& p) const
    {
        return {exact::floor(p[0] / size_), exact::floor(p[1] / size_), exact::floor(p[2] / size_)};
    }
    std::size_t list_of(const Cell& cell) const
    {
        std::uint64_t hash = 0;
        for (long long c : cell) hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
        return (hash >> 32) & mask_;
    }

    double size_;
    std::size_t mask_ = 1;
    std::vector<std::uint32_t> start_, members_;
};

} // namespace

Particles::Particles(std::vector<Vec> points, std::vector<Link> links, const Obstacles& obstacles,
                     const Settings& settings)
    : position(std::move(points)), velocity(position.size(), Vec{}), rest_(position), previous_(position),
      links_(std::move(links)), obstacles_(obstacles), settings_(settings)
{
}

void Particles::step(double dt)
{
    const double kept = 1.0 - settings_.damping * dt;
    for (std::size_t i = 0; i < position.size(); ++i) {
        velocity[i][1] -= settings_.gravity * dt;
        previous_[i] = position[i];
        position[i] = position[i] + dt * kept * velocity[i];
    }
    satisfy_links(dt);
    satisfy_hinges(dt);
    if (settings_.thickness > 0.0) keep_apart();
    collide();
    for (std::size_t i = 0; i < position.size(); ++i) velocity[i] = (1.0 / dt) * (position[i] - previous_[i]);
    ++steps_;
}

void Particles::satisfy_links(double dt)
{
    const std::size_t count = links_.size();
    for (std::size_t k = 0; k < count; ++k) {
        const Link& link = links_[steps_ % 2 == 1 ? count - 1 - k : k];
        const Vec apart = position[link.b] - position[link.a];
        const double distance = length(apart);
        if (distance == 0.0) continue;
        const Vec move = ((distance - link.rest) / (distance * (2.0 + link.compliance / (dt * dt)))) * apart;
        position[link.a] = position[link.a] + move;
        position[link.b] = position[link.b] - move;
    }
}

void Particles::satisfy_hinges(double dt)
{
    for (const Hinge& hinge : hinges_) {
        Vec off{};
        double weight = hinge.compliance / (dt * dt);
        for (std::size_t i = 0; i < 4; ++i) {
            off = off + hinge.weight[i] * position[hinge.at[i]];
            weight += hinge.weight[i] * hinge.weight[i];
        }
        for (std::size_t i = 0; i < 4; ++i)
            position[hinge.at[i]] = position[hinge.at[i]] - (hinge.weight[i] / weight) * off;
    }
}

/// Lists the pairs closer than one and a half thicknesses that are further apart at rest.
void Particles::find_near()
{
    const double reach = 1.5 * settings_.thickness;
    const Cells cells(position, reach);
    near_.clear();
    for (std::uint32_t a = 0; a < position.size(); ++a)
        cells.for_each_around(position[a], [&](std::uint32_t b) {
            const Vec apart = position[b] - position[a], at_rest = rest_[b] - rest_[a];
            if (b > a && dot(apart, apart) < reach * reach && dot(at_rest, at_rest) > reach * reach)
                near_.push_back({a, b});
        });
}

void Particles::repel(Near pair)
{
    Vec &a = position[pair.a], &b = position[pair.b];
    const Vec apart = b - a;
    const double square = dot(apart, apart);
    if (square >= settings_.thickness * settings_.thickness || square == 0.0) return;
    const double distance = std::sqrt(square);
    const Vec move = (0.5 * (settings_.thickness - distance) / distance) * apart;
    // What touches moves together: friction of cloth on cloth.
    const Vec drag = 0.1 * settings_.friction * ((b - previous_[pair.b]) - (a - previous_[pair.a]));
    a = a - move + drag;
    b = b + move - drag;
}

void Particles::keep_apart()
{
    constexpr std::uint64_t steps_a_list = 4;
    if (steps_ % steps_a_list == 0) find_near();
    for (const Near& pair : near_) repel(pair);
}

void Particles::collide()
{
    for (std::size_t i = 0; i < position.size(); ++i)
        for (const auto& find : {ball_contact, ring_contact, ground_contact}) {
            const std::optional<Contact> contact = find(obstacles_, position[i], settings_.skin);
            if (!contact) continue;
            position[i] = position[i] + contact->depth * contact->normal;
            const Vec moved = position[i] - previous_[i];
            const Vec sliding = moved - dot(moved, contact->normal) * contact->normal;
            position[i] = position[i] - settings_.friction * sliding;
        }
}

} // namespace meshreel::shapes
