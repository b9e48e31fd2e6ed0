/// Grids, and edge splits to reach an exact vertex count.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/shapes/body.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "meshreel/mesh/corner_table.h"

namespace meshreel::shapes {

namespace {

double squared_length(const Body& body, const Edge& edge)
{
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double d = body.points[edge.low.value][i] - body.points[edge.high.value][i];
        square += d * d;
    }
    return square;
}

/// Adds the middle of an edge as a vertex.
std::uint32_t add_middle(Body& body, std::uint32_t a, std::uint32_t b)
{
    std::array<double, 3> middle;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (body.points[a][i] + body.points[b][i]);
    body.points.push_back(middle);
    if (!body.uv.empty())
        body.uv.push_back({0.5 * (body.uv[a][0] + body.uv[b][0]), 0.5 * (body.uv[a][1] + body.uv[b][1])});
    return static_cast<std::uint32_t>(body.points.size() - 1);
}

/// Cuts the triangle of a corner in two, from the corner to `middle` on the edge it faces.
void cut(Body& body, CornerId c, std::uint32_t middle)
{
    const std::size_t t = triangle_of(c).value;
    Triangle other = body.triangles[t];
    body.triangles[t][previous(c).value % 3] = middle;
    other[next(c).value % 3] = middle;
    body.triangles.push_back(other);
}

/// One round: splits up to `count` of the longest edges, none of them in a common triangle.
std::uint32_t split_round(Body& body, std::uint32_t count)
{
    const std::vector<Triangle> before = body.triangles;
    const CornerTable table(static_cast<std::uint32_t>(body.points.size()), before);
    std::vector<std::pair<double, std::uint32_t>> longest;
    for (std::uint32_t e = 0; e < table.edge_count(); ++e)
        longest.emplace_back(-squared_length(body, table.edge(e)), e);
    std::sort(longest.begin(), longest.end());
    std::vector<std::uint8_t> used(before.size(), 0);
    std::uint32_t done = 0;
    for (const auto& [length, e] : longest) {
        const Edge edge = table.edge(e);
        const bool taken = std::any_of(edge.corners.begin(), edge.corners.end(),
                                       [&](CornerId c) { return used[triangle_of(c).value] != 0; });
        if (taken) continue;
        const std::uint32_t middle = add_middle(body, edge.low.value, edge.high.value);
        for (CornerId c : edge.corners) {
            used[triangle_of(c).value] = 1;
            cut(body, c, middle);
        }
        if (++done == count) break;
    }
    return done;
}

/// 32-bit values as little-endian bytes.
template <class T>
Bytes bytes_of(const std::vector<T>& values)
{
    Bytes bytes;
    for (const T& value : values) {
        std::uint32_t word;
        static_assert(sizeof(word) == sizeof(value));
        std::memcpy(&word, &value, sizeof word);
        for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
    }
    return bytes;
}

} // namespace

Body grid(const GridSize& size)
{
    Body body;
    for (std::uint32_t j = 0; j < size.rows; ++j)
        for (std::uint32_t i = 0; i < size.columns; ++i) {
            const double u = static_cast<double>(i) / (size.columns - 1), v = static_cast<double>(j) / (size.rows - 1);
            body.points.push_back({u * size.width, v * size.height, 0.0});
            body.uv.push_back({u, v});
        }
    for (std::uint32_t j = 0; j + 1 < size.rows; ++j)
        for (std::uint32_t i = 0; i + 1 < size.columns; ++i) {
            const std::uint32_t a = j * size.columns + i, b = a + 1, c = a + size.columns, d = c + 1;
            if ((i + j) % 2 == 0) {
                body.triangles.push_back({a, b, d});
                body.triangles.push_back({a, d, c});
            } else {
                body.triangles.push_back({a, b, c});
                body.triangles.push_back({b, d, c});
            }
        }
    return body;
}

GridSize grid_size(std::uint32_t vertices, double width, double height)
{
    // (columns - 1) / (rows - 1) = width / height and columns * rows = vertices, rounded down.
    const double square = std::sqrt(static_cast<double>(vertices) * width / height);
    const auto columns = std::clamp<std::uint32_t>(static_cast<std::uint32_t>(square), 2, vertices / 2);
    return {columns, vertices / columns, width, height};
}

void split_edges(Body& body, std::uint32_t vertices)
{
    while (body.points.size() < vertices) {
        const auto missing = static_cast<std::uint32_t>(vertices - body.points.size());
        if (split_round(body, missing) == 0) return; // no edge to split
    }
}

Animation animation_of(const Body& body, const ShapeOptions& options)
{
    Animation animation;
    animation.vertex_count = static_cast<std::uint32_t>(body.points.size());
    animation.triangles = body.triangles;
    animation.positions.resize(std::size_t{options.frames} * animation.vertex_count * 3);
    animation.times_s = uniform_times(options.frames, options.fps);
    animation.meta.fps = options.fps;
    if (!body.uv.empty()) {
        std::vector<float> uv;
        for (const auto& [u, v] : body.uv) uv.insert(uv.end(), {static_cast<float>(u), static_cast<float>(v)});
        animation.appearance.attributes.push_back({"uv0", Domain::vertex, Scalar::f32, 2, false, bytes_of(uv), {}});
    }
    return animation;
}

Attribute triangle_numbers(const char* name, const std::vector<std::uint32_t>& numbers)
{
    return {name, Domain::triangle, Scalar::u32, 1, false, bytes_of(numbers), {}};
}

} // namespace meshreel::shapes
