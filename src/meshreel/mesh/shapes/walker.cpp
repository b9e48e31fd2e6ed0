/// A walking human figure: a closed skin, smoothly bound to thirteen bones.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/mesh/shapes/figure.h"
#include "meshreel/mesh/shapes/makers.h"

namespace meshreel::shapes {

namespace {

/// A rotation, rows first, and a shift.
struct Pose {
    std::array<Vec, 3> row{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec shift{0, 0, 0};

    Vec turned(const Vec& p) const { return {dot(row[0], p), dot(row[1], p), dot(row[2], p)}; }
    Vec operator()(const Vec& p) const { return turned(p) + shift; }
    /// First `inner`, then this.
    Pose operator*(const Pose& inner) const
    {
        Pose result;
        for (std::size_t column = 0; column < 3; ++column) {
            const Vec image = turned({inner.row[0][column], inner.row[1][column], inner.row[2][column]});
            for (std::size_t i = 0; i < 3; ++i) result.row[i][column] = image[i];
        }
        result.shift = (*this)(inner.shift);
        return result;
    }
};

/// A turn about a coordinate axis, right-handed, radians.
Pose turn(std::size_t axis, double angle)
{
    const double c = exact::cos(angle), s = exact::sin(angle);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Pose pose;
    pose.row[u][u] = pose.row[v][v] = c;
    pose.row[u][v] = -s;
    pose.row[v][u] = s;
    return pose;
}
Pose pitch(double forward)
{
    return turn(0, -forward);
} ///< swings what hangs down forwards
Pose twist(double left)
{
    return turn(1, left);
}
Pose roll(double angle)
{
    return turn(2, angle);
}

/// How this figure walks.
struct Gait {
    double phase, steps_per_second, stride, arm_swing, lean;

    explicit Gait(std::uint64_t seed)
    {
        Random random(seed);
        phase = random.uniform(0.0, 2.0 * pi);
        steps_per_second = random.uniform(0.85, 1.0);
        stride = random.uniform(0.40, 0.46);
        arm_swing = random.uniform(0.35, 0.5);
        lean = random.uniform(0.03, 0.07);
    }
};

using Poses = std::array<Pose, bone_count>;

/// Hip, knee and ankle of one leg; at cycle 0 it swings past the other one.
std::array<Pose, 3> leg(const Gait& gait, double cycle)
{
    const double lift = 0.5 * (1.0 + exact::cos(cycle + 0.3));
    const double hip = 0.08 + gait.stride * exact::sin(cycle), knee = 0.10 + 0.90 * lift * lift * lift;
    const double roll_off = 0.5 * (1.0 + exact::cos(cycle + 1.5)); // the heel leaves the ground first
    return {pitch(hip), pitch(-knee), pitch(0.75 * (knee - hip) - 0.45 * roll_off * roll_off + 0.08)};
}

/// Shoulder and elbow of one arm; side is 1 for the left one.
std::array<Pose, 2> arm(const Gait& gait, double cycle, double side)
{
    const double swing = gait.arm_swing * exact::sin(cycle);
    return {pitch(swing) * roll(-side * 1.36), twist(-side * (0.35 + 0.25 * (1.0 + exact::sin(cycle)) * 0.5))};
}

/// Turns of all bones about their joints, at one moment of the cycle.
Poses local_turns(const Gait& gait, double cycle)
{
    const double swing = exact::sin(cycle);
    const auto left_leg = leg(gait, cycle), right_leg = leg(gait, cycle + pi);
    const auto left_arm = arm(gait, cycle + pi, 1.0), right_arm = arm(gait, cycle, -1.0);
    return {twist(-0.10 * swing) * roll(0.035 * exact::cos(cycle)),
            twist(0.20 * swing) * pitch(-gait.lean) * roll(-0.045 * exact::cos(cycle)),
            twist(-0.09 * swing) * pitch(0.6 * gait.lean),
            left_arm[0],
            left_arm[1],
            right_arm[0],
            right_arm[1],
            left_leg[0],
            left_leg[1],
            left_leg[2],
            right_leg[0],
            right_leg[1],
            right_leg[2]};
}

/// Poses of all bones, from rest to the cycle's moment, the pelvis in place.
Poses bone_poses(const Gait& gait, double cycle)
{
    Poses poses = local_turns(gait, cycle);
    for (std::size_t b = 0; b < bone_count; ++b) {
        const Joint& joint = joints()[b];
        poses[b].shift = joint.at - poses[b].turned(joint.at); // about the joint
        if (b > 0) poses[b] = poses[static_cast<std::size_t>(joint.parent)] * poses[b];
    }
    return poses;
}

/// The height of the lowest point of both soles.
double lowest_sole(const Poses& poses)
{
    double lowest = 1e9;
    for (const auto& [bone, side] : {std::pair{Bone::left_foot, 1.0}, {Bone::right_foot, -1.0}})
        for (const Vec& point : {Vec{0.10, 0.0, -0.04}, Vec{0.11, 0.0, 0.08}, Vec{0.115, 0.005, 0.16}}) {
            const Vec sole{side * point[0], point[1], point[2]};
            lowest = std::min(lowest, poses[static_cast<std::size_t>(bone)](sole)[1]);
        }
    return lowest;
}

void skin_frame(const Figure& figure, const Poses& poses, std::span<float> out)
{
    for (std::size_t v = 0; v < figure.body.points.size(); ++v) {
        Vec point{};
        for (std::size_t b = 0; b < bone_count; ++b) {
            const double weight = figure.weight(v, b);
            if (weight != 0.0) point = point + weight * poses[b](figure.body.points[v]);
        }
        for (std::size_t i = 0; i < 3; ++i) out[3 * v + i] = static_cast<float>(point[i]);
    }
}

/// Which group and material each bone's skin belongs to.
struct Clothing {
    std::uint32_t group, material;
};
constexpr std::array<Clothing, bone_count> clothing{
    {{1, 2}, {1, 1}, {0, 0}, {2, 1}, {2, 0}, {3, 1}, {3, 0}, {4, 2}, {4, 2}, {4, 3}, {5, 2}, {5, 2}, {5, 3}}};

/// The bone that holds most of a triangle.
std::size_t bone_of(const Figure& figure, const Triangle& triangle)
{
    std::array<double, bone_count> sum{};
    for (std::uint32_t v : triangle)
        for (std::size_t b = 0; b < bone_count; ++b) sum[b] += figure.weight(v, b);
    return static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
}

void dress(const Figure& figure, Animation& animation)
{
    std::vector<std::uint32_t> group, material;
    for (const Triangle& triangle : figure.body.triangles) {
        group.push_back(clothing[bone_of(figure, triangle)].group);
        material.push_back(clothing[bone_of(figure, triangle)].material);
    }
    animation.appearance.groups = {"head", "trunk", "left arm", "right arm", "left leg", "right leg"};
    animation.appearance.materials = {"skin", "shirt", "trousers", "shoes"};
    animation.appearance.attributes.push_back(triangle_numbers("group", group));
    animation.appearance.attributes.push_back(triangle_numbers("material", material));
}

} // namespace

Animation walker(const ShapeOptions& options)
{
    const Figure person = figure(options.vertices);
    Animation animation = animation_of(person.body, options);
    animation.meta.name = "walker";
    animation.meta.up = Axis::y;
    animation.meta.metres_per_unit = 1.0;
    dress(person, animation);

    const Gait gait(options.seed);
    const double speed =
        4.0 * 0.87 * exact::sin(gait.stride) * gait.steps_per_second; // two steps of a leg's swing a cycle
    for (std::size_t f = 0; f < options.frames; ++f) {
        const double t = animation.times_s[f];
        Poses poses = bone_poses(gait, 2.0 * pi * gait.steps_per_second * t + gait.phase);
        const Vec place{0.0, -lowest_sole(poses), speed * t};
        for (Pose& pose : poses) pose.shift = pose.shift + place;
        skin_frame(person, poses, animation.frame(f));
    }
    return animation;
}

} // namespace meshreel::shapes
