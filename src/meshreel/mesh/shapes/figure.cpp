/// The figure: blocks pulled onto round cones that flow into each other.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/shapes/figure.h"

#include <algorithm>

#include "meshreel/mesh/corner_table.h"
#include "meshreel/mesh/shapes/blocks.h"

namespace meshreel::shapes {

namespace {

/// A cone with round ends, given for the left side or the middle.
struct Cone {
    Bone bone;
    Vec a, b;
    double radius_a, radius_b;
};

constexpr std::array cones{
    Cone{Bone::pelvis, {-0.065, 0.93, 0.0}, {0.065, 0.93, 0.0}, 0.115, 0.115},
    Cone{Bone::pelvis, {0.0, 0.95, 0.01}, {0.0, 1.08, 0.01}, 0.115, 0.115},
    Cone{Bone::chest, {0.0, 1.10, 0.01}, {0.0, 1.22, 0.01}, 0.115, 0.125},
    Cone{Bone::chest, {-0.085, 1.29, 0.0}, {0.085, 1.29, 0.0}, 0.115, 0.115},
    Cone{Bone::chest, {0.0, 1.36, 0.0}, {0.17, 1.39, -0.01}, 0.085, 0.065},
    Cone{Bone::head, {0.0, 1.42, -0.01}, {0.0, 1.54, 0.0}, 0.055, 0.055},
    Cone{Bone::head, {0.0, 1.59, 0.02}, {0.0, 1.65, 0.0}, 0.085, 0.105},
    Cone{Bone::left_upper_arm, {0.19, 1.385, -0.01}, {0.45, 1.385, -0.01}, 0.058, 0.042},
    Cone{Bone::left_forearm, {0.45, 1.385, -0.01}, {0.70, 1.385, 0.0}, 0.044, 0.028},
    Cone{Bone::left_forearm, {0.72, 1.385, 0.0}, {0.82, 1.38, 0.005}, 0.038, 0.030},
    Cone{Bone::left_thigh, {0.095, 0.90, 0.0}, {0.10, 0.50, 0.01}, 0.088, 0.058},
    Cone{Bone::left_shin, {0.10, 0.50, 0.01}, {0.10, 0.33, -0.015}, 0.055, 0.056},
    Cone{Bone::left_shin, {0.10, 0.33, -0.015}, {0.10, 0.09, -0.01}, 0.056, 0.036},
    Cone{Bone::left_foot, {0.10, 0.045, -0.03}, {0.115, 0.035, 0.15}, 0.045, 0.035},
};

Vec mirrored(const Vec& p)
{
    return {-p[0], p[1], p[2]};
}

Bone mirrored(Bone bone)
{
    constexpr std::array<Bone, bone_count> other{
        Bone::pelvis,         Bone::chest,        Bone::head,        Bone::right_upper_arm, Bone::right_forearm,
        Bone::left_upper_arm, Bone::left_forearm, Bone::right_thigh, Bone::right_shin,      Bone::right_foot,
        Bone::left_thigh,     Bone::left_shin,    Bone::left_foot};
    return other[static_cast<std::size_t>(bone)];
}

double distance_to(const Cone& cone, const Vec& p)
{
    const Vec axis = cone.b - cone.a, from = p - cone.a;
    const double t = std::clamp(dot(from, axis) / dot(axis, axis), 0.0, 1.0);
    return length(from - t * axis) - (cone.radius_a + t * (cone.radius_b - cone.radius_a));
}

/// The smaller of two distances, flowing into each other where they differ by less than `width`.
double smooth_minimum(double a, double b, double width)
{
    const double overlap = std::max(0.0, width - std::abs(a - b)) / width;
    return std::min(a, b) - 0.25 * width * overlap * overlap;
}

/// Distance to the skin, negative inside. Only the limbs of the point's own side count: legs that nearly touch stay two.
double skin_distance(const Vec& point)
{
    const Vec p{std::abs(point[0]), point[1], point[2]};
    double distance = 1e9;
    for (const Cone& cone : cones) distance = smooth_minimum(distance, distance_to(cone, p), 0.045);
    return distance;
}

Bone nearest_bone(const Vec& point)
{
    const bool right = point[0] < 0.0;
    const Vec p = right ? mirrored(point) : point;
    const auto nearest = std::min_element(cones.begin(), cones.end(), [&](const Cone& a, const Cone& b) {
        return distance_to(a, p) < distance_to(b, p);
    });
    return right ? mirrored(nearest->bone) : nearest->bone;
}

/// Moves a point towards the skin along the gradient of the distance.
Vec pulled_to_skin(const Vec& p)
{
    constexpr double h = 1e-4;
    const Vec slope{skin_distance(p + Vec{h, 0, 0}) - skin_distance(p - Vec{h, 0, 0}),
                    skin_distance(p + Vec{0, h, 0}) - skin_distance(p - Vec{0, h, 0}),
                    skin_distance(p + Vec{0, 0, h}) - skin_distance(p - Vec{0, 0, h})};
    const double steep = length(slope);
    return steep == 0.0 ? p : p - (skin_distance(p) / steep) * slope;
}

/// Neighbours of each vertex along edges: at[first[v]] .. at[first[v + 1]].
struct Neighbours {
    std::vector<std::uint32_t> first, at;

    explicit Neighbours(const Body& body) : first(body.points.size() + 1, 0)
    {
        const CornerTable table(static_cast<std::uint32_t>(body.points.size()), body.triangles);
        for (std::uint32_t e = 0; e < table.edge_count(); ++e)
            for (VertexId v : {table.edge(e).low, table.edge(e).high}) ++first[v.value + 1ul];
        for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
        at.resize(first.back());
        std::vector<std::uint32_t> place(first.begin(), first.end() - 1);
        for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
            const Edge edge = table.edge(e);
            at[place[edge.low.value]++] = edge.high.value;
            at[place[edge.high.value]++] = edge.low.value;
        }
    }
    std::span<const std::uint32_t> of(std::size_t v) const { return {at.data() + first[v], first[v + 1] - first[v]}; }
};

/// Halfway to the middle of its neighbours, every value at once.
template <class Value, class Zero>
std::vector<Value> smoothed(const std::vector<Value>& values, const Neighbours& neighbours, const Zero& zero)
{
    std::vector<Value> result(values.size());
    for (std::size_t v = 0; v < values.size(); ++v) {
        Value sum = zero;
        for (std::uint32_t n : neighbours.of(v))
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[n][i];
        const double share = 0.5 / static_cast<double>(neighbours.of(v).size());
        for (std::size_t i = 0; i < sum.size(); ++i) result[v][i] = 0.5 * values[v][i] + share * sum[i];
    }
    return result;
}

/// Blocks where the skin will be.
Blocks figure_blocks()
{
    Blocks blocks;
    blocks.planes = {
        {{-0.84, -0.17, -0.055, 0.055, 0.17, 0.84}, {0.0, 0.10, 0.86, 1.32, 1.44, 1.51, 1.74}, {-0.07, 0.07, 0.19}}};
    for (std::uint32_t side : {1u, 3u}) // feet and legs
        for (const auto& [j, k] : {std::pair{0u, 0u}, {0u, 1u}, {1u, 0u}}) blocks.filled.push_back({side, j, k});
    for (std::uint32_t i : {1u, 2u, 3u}) blocks.filled.push_back({i, 2, 0});         // trunk
    for (std::uint32_t i : {0u, 1u, 2u, 3u, 4u}) blocks.filled.push_back({i, 3, 0}); // arms and shoulders
    for (std::uint32_t j : {4u, 5u}) blocks.filled.push_back({2, j, 0});             // neck and head
    return blocks;
}

using Weights = std::array<double, bone_count>;

/// All of a vertex to its nearest bone, then smoothed over about 5 cm of skin.
Matrix<double> skin_weights(const Body& body, const Neighbours& neighbours)
{
    std::vector<Weights> weights(body.points.size(), Weights{});
    for (std::size_t v = 0; v < weights.size(); ++v)
        weights[v][static_cast<std::size_t>(nearest_bone(body.points[v]))] = 1.0;
    constexpr double area = 1.9, width = 0.05; // m^2 of skin, m
    const auto rounds = static_cast<int>(2.0 * width * width * static_cast<double>(body.points.size()) / area) + 1;
    for (int i = 0; i < std::min(rounds, 400); ++i) weights = smoothed(weights, neighbours, Weights{});
    Matrix<double> result(weights.size(), bone_count);
    for (std::size_t v = 0; v < weights.size(); ++v)
        std::copy(weights[v].begin(), weights[v].end(), result.row(v).begin());
    return result;
}

} // namespace

const std::array<Joint, bone_count>& joints()
{
    static constexpr std::array<Joint, bone_count> table{{
        {Bone::pelvis, {0.0, 0.95, 0.0}},
        {Bone::pelvis, {0.0, 1.08, 0.0}},
        {Bone::chest, {0.0, 1.47, -0.01}},
        {Bone::chest, {0.18, 1.385, -0.01}},
        {Bone::left_upper_arm, {0.45, 1.385, -0.01}},
        {Bone::chest, {-0.18, 1.385, -0.01}},
        {Bone::right_upper_arm, {-0.45, 1.385, -0.01}},
        {Bone::pelvis, {0.095, 0.90, 0.0}},
        {Bone::left_thigh, {0.10, 0.50, 0.0}},
        {Bone::left_shin, {0.10, 0.08, -0.01}},
        {Bone::pelvis, {-0.095, 0.90, 0.0}},
        {Bone::right_thigh, {-0.10, 0.50, 0.0}},
        {Bone::right_shin, {-0.10, 0.08, -0.01}},
    }};
    return table;
}

Figure figure(std::uint32_t vertices)
{
    Figure result;
    result.body = block_surface(figure_blocks(), vertices);
    const Neighbours neighbours(result.body);
    for (int round = 0; round < 10; ++round) {
        if (round < 8) result.body.points = smoothed(result.body.points, neighbours, Vec{});
        for (Vec& p : result.body.points) p = pulled_to_skin(p);
    }
    result.weight = skin_weights(result.body, neighbours);
    return result;
}

} // namespace meshreel::shapes
