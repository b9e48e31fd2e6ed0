/// The camera, the shading and the z-buffer.
// SPDX-License-Identifier: MIT
#include "cli/pictures/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace meshreel::cli {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(const Vector& a)
{
    const double length = std::sqrt(dot(a, a));
    return length > 0.0 ? Vector{a[0] / length, a[1] / length, a[2] / length} : Vector{};
}

Vector point(std::span<const float> positions, std::size_t v)
{
    return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
}

/// Up, and the direction that faces the viewer before the camera is turned.
std::array<Vector, 2> up_and_front(Axis up)
{
    if (up == Axis::x) return {Vector{1, 0, 0}, Vector{0, 0, 1}};
    if (up == Axis::z) return {Vector{0, 0, 1}, Vector{0, -1, 0}};
    return {Vector{0, 1, 0}, Vector{0, 0, 1}};
}

/// Smallest and largest projected x and y.
struct Bounds {
    std::array<double, 2> low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    std::array<double, 2> high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    double size(std::size_t axis) const { return high[axis] - low[axis]; }
};

Bounds projected_bounds(std::span<const Pose> poses, const Camera& camera)
{
    Bounds bounds;
    for (const Pose& pose : poses) {
        for (std::size_t v = 0; v < pose.size() / 3; ++v) {
            const Vector p = point(pose, v);
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const double x = dot(p, camera.axes[axis]);
                bounds.low[axis] = std::min(bounds.low[axis], x);
                bounds.high[axis] = std::max(bounds.high[axis], x);
            }
        }
    }
    return bounds;
}

/// Unit normals of the vertices: the sum of the triangles' area vectors. [V]
std::vector<Vector> vertex_normals(const Scene& scene)
{
    std::vector<Vector> normals(scene.positions.size() / 3, Vector{});
    for (const Triangle& t : scene.triangles) {
        const Vector a = point(scene.positions, t[0]);
        const Vector b = point(scene.positions, t[1]);
        const Vector c = point(scene.positions, t[2]);
        const Vector area = cross({b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {c[0] - a[0], c[1] - a[1], c[2] - a[2]});
        for (std::uint32_t v : t)
            for (std::size_t i = 0; i < 3; ++i) normals[v][i] += area[i];
    }
    for (Vector& normal : normals) normal = unit(normal);
    return normals;
}

/// A key light from the upper left of the eye and a soft light from above.
Colour shade(const Colour& colour, Vector normal, double relief, const Camera& camera)
{
    if (dot(normal, camera.axes[2]) > 0.0) normal = {-normal[0], -normal[1], -normal[2]};
    const double right = dot(normal, camera.axes[0]);
    const double above = -dot(normal, camera.axes[1]);
    const double towards = -dot(normal, camera.axes[2]);
    const double key = std::max(0.0, -0.48 * right + 0.62 * above + 0.62 * towards);
    const double light = 1.0 + relief * (0.18 + 0.15 * (1.0 + above) + 0.74 * key - 1.0);
    const double shine = 0.10 * std::max(0.0, 2.0 * relief - 1.0); // none where colours are to be read
    const double gloss = shine * std::pow(std::max(0.0, -0.27 * right + 0.36 * above + 0.89 * towards), 24.0);
    Colour lit{};
    for (std::size_t c = 0; c < 3; ++c) lit[c] = static_cast<float>(light * colour[c] + gloss);
    return lit;
}

/// A vertex on its way to the screen.
struct Corner {
    double x = 0.0, y = 0.0, depth = 0.0; ///< pixels
    Colour colour{};
};

std::vector<Corner> project(const Scene& scene, const Camera& camera)
{
    const std::vector<Vector> normals = vertex_normals(scene);
    std::vector<Corner> corners(normals.size());
    for (std::size_t v = 0; v < corners.size(); ++v) {
        const Vector p = point(scene.positions, v);
        const double scale = camera.pixels_per_unit;
        corners[v].x = scale * (dot(p, camera.axes[0]) - camera.centre[0]) + 0.5 * static_cast<double>(camera.width);
        corners[v].y = scale * (dot(p, camera.axes[1]) - camera.centre[1]) + 0.5 * static_cast<double>(camera.height);
        corners[v].depth = scale * dot(p, camera.axes[2]);
        corners[v].colour = shade(scene.colours[v], normals[v], scene.relief, camera);
    }
    return corners;
}

/// The pixels lo .. hi - 1 whose middle can lie between two coordinates.
std::array<std::size_t, 2> pixel_range(double low, double high, std::size_t size)
{
    const double limit = static_cast<double>(size);
    return {static_cast<std::size_t>(std::clamp(std::floor(low), 0.0, limit)),
            static_cast<std::size_t>(std::clamp(std::ceil(high) + 1.0, 0.0, limit))};
}

/// An image with the depth of its pixels.
class Raster {
public:
    Raster(std::size_t width, std::size_t height)
        : image(width, height), depth_(width * height, std::numeric_limits<double>::infinity())
    {
    }

    void draw(const Corner& a, const Corner& b, const Corner& c)
    {
        const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (area == 0.0) return;
        const auto [x0, x1] = pixel_range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), image.width);
        const auto [y0, y1] = pixel_range(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), image.height);
        for (std::size_t y = y0; y < y1; ++y) {
            for (std::size_t x = x0; x < x1; ++x) {
                const double px = static_cast<double>(x) + 0.5;
                const double py = static_cast<double>(y) + 0.5;
                const double wb = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
                const double wc = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
                const std::array weights{1.0 - wb - wc, wb, wc};
                if (std::min({weights[0], wb, wc}) >= 0.0) put(y * image.width + x, {&a, &b, &c}, weights);
            }
        }
    }

    /// colour(x, y, z): of a ball where its normal points to the right, down and to the eye by so much.
    template <class Lit>
    void draw_ball(const Corner& c, double radius, const Lit& colour)
    {
        const auto [x0, x1] = pixel_range(c.x - radius, c.x + radius, image.width);
        const auto [y0, y1] = pixel_range(c.y - radius, c.y + radius, image.height);
        for (std::size_t y = y0; y < y1; ++y) {
            for (std::size_t x = x0; x < x1; ++x) {
                const double dx = (static_cast<double>(x) + 0.5 - c.x) / radius;
                const double dy = (static_cast<double>(y) + 0.5 - c.y) / radius;
                const double square = 1.0 - dx * dx - dy * dy;
                if (square <= 0.0) continue;
                const double dz = std::sqrt(square), depth = c.depth - radius * dz;
                if (depth < depth_[y * image.width + x]) set(y * image.width + x, depth, colour(dx, dy, dz));
            }
        }
    }

    Image image;

private:
    void set(std::size_t pixel, double depth, const Colour& colour)
    {
        depth_[pixel] = depth;
        image.colours[pixel] = colour;
        image.opacity[pixel] = 1.0f;
    }

    void put(std::size_t pixel, const std::array<const Corner*, 3>& corners, const std::array<double, 3>& weights)
    {
        double depth = 0.0;
        Colour colour{};
        for (std::size_t i = 0; i < 3; ++i) {
            depth += weights[i] * corners[i]->depth;
            for (std::size_t c = 0; c < 3; ++c) colour[c] += static_cast<float>(weights[i]) * corners[i]->colour[c];
        }
        if (depth < depth_[pixel]) set(pixel, depth, colour);
    }

    std::vector<double> depth_;
};

/// Every vertex as a ball, so large that those of a surface nearly touch.
void draw_balls(Raster& raster, std::span<const Corner> corners, const Scene& scene, const Camera& camera)
{
    const double area = static_cast<double>(camera.width * camera.height) / static_cast<double>(corners.size() + 1);
    const double radius = std::clamp(0.4 * std::sqrt(area), 2.0, 24.0);
    for (std::size_t v = 0; v < corners.size(); ++v) {
        const Corner& c = corners[v];
        const auto lit = [&](double dx, double dy, double dz) {
            Vector normal{};
            for (std::size_t i = 0; i < 3; ++i)
                normal[i] = dx * camera.axes[0][i] + dy * camera.axes[1][i] - dz * camera.axes[2][i];
            return shade(scene.colours[v], normal, scene.relief, camera);
        };
        raster.draw_ball(c, radius, lit);
    }
}

/// The camera's axes after the object has turned about its upright axis.
Camera turned(Axis up, double turn)
{
    const auto [above, front] = up_and_front(up);
    const Vector side = cross(above, front);
    Vector towards{}, right{}, away{};
    for (std::size_t i = 0; i < 3; ++i) towards[i] = std::cos(turn) * front[i] - std::sin(turn) * side[i];
    right = cross(above, towards);
    for (std::size_t i = 0; i < 3; ++i) away[i] = 0.45 * right[i] - 0.42 * above[i] - 0.79 * towards[i];
    Camera camera;
    camera.axes[2] = unit(away);
    camera.axes[0] = unit(cross(camera.axes[2], above));
    camera.axes[1] = cross(camera.axes[2], camera.axes[0]);
    return camera;
}

/// Each camera looks at the middle of its bounds; scale and size are those that all of them need.
void fit(std::span<Camera> cameras, std::span<const Bounds> bounds, std::size_t width)
{
    constexpr double margin = 1.06;
    double wide = 1e-30, high = 0.0;
    for (const Bounds& one : bounds) {
        wide = std::max(wide, one.size(0));
        high = std::max(high, one.size(1));
    }
    const double aspect = std::clamp(high / wide, 0.5, 1.2);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        Camera& camera = cameras[i];
        camera.width = width;
        camera.height = static_cast<std::size_t>(aspect * static_cast<double>(width));
        camera.pixels_per_unit = static_cast<double>(width) / (margin * std::max(wide, high / aspect));
        for (std::size_t axis = 0; axis < 2; ++axis)
            camera.centre[axis] = 0.5 * (bounds[i].low[axis] + bounds[i].high[axis]);
    }
}

} // namespace

std::vector<Camera> turntable(std::span<const std::vector<Pose>> poses, const View& first)
{
    const std::size_t count = poses.size();
    std::vector<Camera> cameras;
    std::vector<Bounds> bounds;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        cameras.push_back(turned(first.up, first.turn + 2.0 * std::numbers::pi * share));
        bounds.push_back(projected_bounds(poses[i], cameras.back()));
    }
    fit(cameras, bounds, first.width);
    return cameras;
}

Camera look_at(std::span<const Pose> poses, const View& view)
{
    Camera camera = turned(view.up, view.turn);
    const Bounds bounds = projected_bounds(poses, camera);
    fit({&camera, 1}, {&bounds, 1}, view.width);
    return camera;
}

Image render(const Scene& scene, const Camera& camera)
{
    const std::vector<Corner> corners = project(scene, camera);
    Raster raster(camera.width, camera.height);
    if (scene.triangles.empty()) draw_balls(raster, corners, scene, camera);
    for (const Triangle& t : scene.triangles) raster.draw(corners[t[0]], corners[t[1]], corners[t[2]]);
    return std::move(raster.image);
}

} // namespace meshreel::cli
