/// Prisms of triangles cut along diagonals that the order of the vertices decides.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/space_time.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace meshreel {

namespace {

using MeshEdge = std::pair<std::uint32_t, std::uint32_t>;

MeshEdge ordered_edge(std::uint32_t a, std::uint32_t b)
{
    return {std::min(a, b), std::max(a, b)};
}

/// The different edges of a triangle list, in order. A vertex named twice is no edge.
std::vector<MeshEdge> slice_edges(std::span<const Triangle> triangles)
{
    std::vector<MeshEdge> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            if (t[i] != t[(i + 1) % 3]) edges.push_back(ordered_edge(t[i], t[(i + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// What the three tetrahedra of each prism leave of a time between its frames: (corner, side, side) thrice, and the middle.
std::vector<Triangle> slice_triangles(const Animation& still, std::span<const MeshEdge> edges)
{
    const auto on_edge = [&](std::uint32_t a, std::uint32_t b) {
        if (a == b) return a;
        const auto found = std::lower_bound(edges.begin(), edges.end(), ordered_edge(a, b));
        return still.vertex_count + static_cast<std::uint32_t>(found - edges.begin());
    };
    std::vector<Triangle> triangles;
    triangles.reserve(4 * still.triangles.size());
    for (const auto& [a, b, c] : still.triangles) {
        const std::uint32_t ab = on_edge(a, b), bc = on_edge(b, c), ca = on_edge(c, a);
        triangles.insert(triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return triangles;
}

/// The slice between two frames, [2 x 3V]; s of the way from the first to the second.
Animation slice_between(const Animation& still, MatrixView<const float> frames, double s)
{
    const std::vector<MeshEdge> edges = slice_edges(still.triangles);
    Animation result;
    result.vertex_count = still.vertex_count + static_cast<std::uint32_t>(edges.size());
    result.triangles = slice_triangles(still, edges);
    result.positions.reserve(3ul * result.vertex_count);
    const auto cut = [&](std::uint32_t earlier, std::uint32_t later) {
        for (std::size_t c = 0; c < 3; ++c)
            result.positions.push_back(
                static_cast<float>((1.0 - s) * frames(0, 3ul * earlier + c) + s * frames(1, 3ul * later + c)));
    };
    for (std::uint32_t v = 0; v < still.vertex_count; ++v) cut(v, v);
    for (const MeshEdge& e : edges)
        cut(e.first, e.second); // a diagonal: from the lower vertex to the higher one, later
    return result;
}

/// Whether a run of vertices has the time of its first one.
bool same_time(const SpaceTimeMesh& mesh, std::size_t frame)
{
    const std::size_t V = mesh.vertices_a_frame;
    for (std::size_t v = 0; v < V; ++v)
        if (mesh.vertices(frame * V + v, 3) != mesh.vertices(frame * V, 3)) return false;
    return true;
}

/// The seconds that lie at w on the axis, as exactly as doubles have them.
double seconds_at(double w, double units)
{
    const double near = w / units;
    for (const double t : {near, std::nextafter(near, HUGE_VAL), std::nextafter(near, -HUGE_VAL)})
        if (t * units == w) return t;
    return near;
}

/// Times and positions of all frames.
Status take_frames(const SpaceTimeMesh& mesh, Animation& animation)
{
    const std::size_t V = mesh.vertices_a_frame, F = V ? mesh.vertices.rows / V : 0;
    if (F * V != mesh.vertices.rows || mesh.vertices.cols != 4)
        return bad_input("the vertices are not whole frames of four coordinates", "vertices");
    for (std::size_t f = 0; f < F; ++f) {
        if (!same_time(mesh, f)) return bad_input("frame " + std::to_string(f) + " has several times", "vertices");
        animation.times_s.push_back(seconds_at(mesh.vertices(f * V, 3), mesh.units_a_second));
    }
    animation.positions.reserve(F * V * 3);
    for (std::size_t i = 0; i < mesh.vertices.rows; ++i)
        for (std::size_t c = 0; c < 3; ++c) animation.positions.push_back(static_cast<float>(mesh.vertices(i, c)));
    return Ok{};
}

/// The triangles, from the first tetrahedron of each prism of the first interval.
Status take_triangles(const SpaceTimeMesh& mesh, Animation& animation)
{
    const std::size_t intervals = animation.frame_count() > 0 ? animation.frame_count() - 1 : 0;
    animation.triangles = mesh.triangles;
    if (intervals == 0)
        return mesh.tetrahedra.empty() ? Status(Ok{}) : bad_input("one frame, but there are tetrahedra", "tetrahedra");
    if (!mesh.triangles.empty()) return bad_input("several frames, but there are triangles", "triangles");
    if (mesh.tetrahedra.size() % (3 * intervals) != 0)
        return bad_input("not three tetrahedra for each triangle and interval", "tetrahedra");
    for (std::size_t t = 0; t < mesh.tetrahedra.size() / intervals; t += 3) {
        const auto& [a, b, c, top] = mesh.tetrahedra[t];
        animation.triangles.push_back({a, b, c});
    }
    return Ok{};
}

void append_interval(std::span<const Tetrahedron> swept_by_all, std::uint32_t first_vertex,
                     std::vector<Tetrahedron>& to)
{
    for (Tetrahedron t : swept_by_all) {
        for (std::uint32_t& corner : t) corner += first_vertex;
        to.push_back(t);
    }
}

} // namespace

double units_a_second(std::span<const float> first_frame, double time_constant)
{
    const double diagonal = first_frame.empty() ? 0.0 : body_diagonal(first_frame);
    return time_constant * (diagonal > 0.0 ? diagonal : 1.0);
}

std::array<Tetrahedron, 3> swept(const Triangle& triangle, std::uint32_t vertex_count)
{
    Triangle low = triangle;
    std::sort(low.begin(), low.end());
    const std::uint32_t V = vertex_count;
    // DEVIATES (7.1, rule 3): the two smaller of the bottom and the two larger of the top; as printed, the other way round,
    // the third tetrahedron has other diagonals than the first two.
    return {Tetrahedron{triangle[0], triangle[1], triangle[2], V + low[2]},
            Tetrahedron{V + triangle[0], V + triangle[1], V + triangle[2], low[0]},
            Tetrahedron{low[0], low[1], V + low[1], V + low[2]}};
}

std::vector<Tetrahedron> interval_tetrahedra(std::span<const Triangle> triangles, std::uint32_t vertex_count)
{
    std::vector<Tetrahedron> all;
    all.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (const Tetrahedron& part : swept(t, vertex_count)) all.push_back(part);
    return all;
}

Result<SpaceTimeMesh> to_space_time(const Animation& animation, double time_constant)
{
    const std::size_t V = animation.vertex_count, F = animation.frame_count();
    if (V * F > UINT32_MAX) return unsupported("more than 2^32 vertices in space-time", "vertex_count");
    SpaceTimeMesh mesh;
    mesh.vertices_a_frame = animation.vertex_count;
    mesh.units_a_second = units_a_second(F > 0 ? animation.frame(0) : std::span<const float>{}, time_constant);
    mesh.vertices = Matrix<double>(F * V, 4);
    for (std::size_t f = 0; f < F; ++f) {
        const double w = animation.times_s[f] * mesh.units_a_second;
        if (f > 0 && w <= animation.times_s[f - 1] * mesh.units_a_second)
            return unsupported("frame " + std::to_string(f) + " is too near in time to the one before", "times");
        for (std::size_t v = 0; v < V; ++v) {
            for (std::size_t c = 0; c < 3; ++c) mesh.vertices(f * V + v, c) = animation.frame(f)[3 * v + c];
            mesh.vertices(f * V + v, 3) = w;
        }
    }
    if (F == 1) mesh.triangles = animation.triangles;
    const std::vector<Tetrahedron> interval = interval_tetrahedra(animation.triangles, animation.vertex_count);
    mesh.tetrahedra.reserve(F > 1 ? interval.size() * (F - 1) : 0);
    for (std::size_t f = 0; f + 1 < F; ++f)
        append_interval(interval, static_cast<std::uint32_t>(f * V), mesh.tetrahedra);
    return mesh;
}

Result<Animation> to_animation(const SpaceTimeMesh& mesh)
{
    Animation animation;
    animation.vertex_count = mesh.vertices_a_frame;
    if (!(mesh.units_a_second > 0.0)) return bad_input("a second must have a length", "units_a_second");
    MESHREEL_CHECK(take_frames(mesh, animation));
    MESHREEL_CHECK(take_triangles(mesh, animation));
    MESHREEL_CHECK(validate(animation));
    const std::vector<Tetrahedron> interval = interval_tetrahedra(animation.triangles, animation.vertex_count);
    std::vector<Tetrahedron> expected;
    for (std::size_t f = 0; f + 1 < animation.frame_count(); ++f) {
        expected.clear();
        append_interval(interval, static_cast<std::uint32_t>(f * mesh.vertices_a_frame), expected);
        if (!std::equal(expected.begin(), expected.end(),
                        mesh.tetrahedra.begin() + static_cast<long>(f * interval.size())))
            return bad_input("the tetrahedra from frame " + std::to_string(f) + " on are not those of moving triangles",
                             "tetrahedra");
    }
    return animation;
}

Result<Animation> slice(FrameSource& source, double time_s)
{
    const Animation& still = source.still();
    const std::vector<double>& times = still.times_s;
    if (times.empty() || !(time_s >= times.front() && time_s <= times.back()))
        return Error{ErrorCode::usage, "the animation has nothing at " + std::to_string(time_s) + " s", "time"};
    const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
    const bool at_frame = times[after - 1] == time_s;
    Matrix<float> room;
    MESHREEL_TRY(const MatrixView<const float> frames, source.frames(after - 1, at_frame ? 1 : 2, room));
    Animation result;
    if (at_frame) {
        result.vertex_count = still.vertex_count;
        result.triangles = still.triangles;
        const std::span<const float> positions = frames.row(0);
        result.positions.assign(positions.begin(), positions.end());
    } else {
        result = slice_between(still, frames, (time_s - times[after - 1]) / (times[after] - times[after - 1]));
    }
    result.times_s = {time_s};
    return result;
}

Result<Animation> slice(const Animation& animation, double time_s)
{
    HeldFrames source(animation);
    return slice(source, time_s);
}

} // namespace meshreel
