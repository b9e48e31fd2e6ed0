/// Space-time: an animation as tetrahedra in four dimensions, the way back, and the surface at any time between frames.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshreel/base/result.h"
#include "meshreel/base/views.h"
#include "meshreel/mesh/animation.h"
#include "meshreel/mesh/frame_source.h"

namespace meshreel {

/// Four corners. Within an interval of two frames: i < V is vertex i in the earlier frame, V + i the same in the later one.
using Tetrahedron = std::array<std::uint32_t, 4>;

/// alpha, body diagonals a second: how far in space is as far as a second in time.  @source thesis 7.1
inline constexpr double usual_time_constant = 0.3;

/// Model units that a second is long on the fourth axis: time_constant times the body diagonal of the first frame [V x 3]
/// (times 1 where that is 0: no frame, no vertex, no extent).
double units_a_second(std::span<const float> first_frame, double time_constant = usual_time_constant);

/// The three tetrahedra that a triangle sweeps from one frame to the next, cut so that neighbours agree on the diagonals of
/// their common side. The first holds the triangle of the earlier frame in its own order, the second that of the later one.
/// A triangle that names a vertex twice gives tetrahedra that do so too, without volume.  @source thesis 7.1
std::array<Tetrahedron, 3> swept(const Triangle& triangle, std::uint32_t vertex_count);

/// Those of all triangles, [3T], triangle after triangle: the same for every interval of an animation, so that a walk
/// through time needs this list and two frames at a time.
std::vector<Tetrahedron> interval_tetrahedra(std::span<const Triangle> triangles, std::uint32_t vertex_count);

/// An animation as one static mesh of tetrahedra in four dimensions.
struct SpaceTimeMesh {
    Matrix<double> vertices;             ///< [F V x 4] x y z and time, model units, frame after frame
    std::vector<Tetrahedron> tetrahedra; ///< [3T (F-1)] indices of vertices, interval after interval
    std::vector<Triangle> triangles;     ///< of a single frame only, which has no tetrahedra: its triangles
    std::uint32_t vertices_a_frame = 0;  ///< V
    double units_a_second = 1.0;         ///< model units of time that a second is long, > 0
};

/// All of an animation at once; a valid one. @pre time_constant > 0 and finite
/// @fails unsupported: more than 2^32 vertices in space-time, or frames so near in time that the axis cannot part them.
Result<SpaceTimeMesh> to_space_time(const Animation& animation, double time_constant = usual_time_constant);

/// The animation that a mesh in space-time came from: positions and triangles exactly, times to the last bit but one.
/// Appearance and metadata are not in the mesh.
/// @fails bad_input: vertices that are not runs of V with equal, increasing times; tetrahedra that no animation sweeps.
Result<Animation> to_animation(const SpaceTimeMesh& mesh);

/// The surface at one time: an animation of one frame. At the time of a frame it is that frame. Between two, the slice of
/// the tetrahedra: each triangle in four, a vertex on every edge [V + E vertices, 4T triangles], closed where the mesh is,
/// turned as it is. Vertex i < V is vertex i.
/// @fails usage: a time before the first frame or after the last. As the source says. @cost O(V + T log T), two frames.
Result<Animation> slice(FrameSource& source, double time_s);
Result<Animation> slice(const Animation& animation, double time_s);

} // namespace meshreel
