/// Triangles of the coarse surface, put at corners of the whole one; then what belongs to those.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/surface_part.h"

#include <optional>

#include "meshreel/mesh/charts.h"
#include "meshreel/mesh/coarse_surface.h"

namespace meshreel {

namespace {

/// Values of some elements alone; of an attribute with indices each value once, of another one an element.
Attribute values_of(const Attribute& attribute, std::span<const std::uint32_t> elements)
{
    constexpr std::uint32_t no_value = 0xffffffff;
    const std::size_t size = scalar_size(attribute.type) * attribute.components;
    std::vector<std::uint32_t> place(attribute.value_count(), no_value);
    Attribute part = attribute;
    part.values.clear();
    part.indices.clear();
    for (const std::uint32_t element : elements) {
        const std::uint32_t old = attribute.indices.empty() ? element : attribute.indices[element];
        if (old == no_value) {
            part.indices.push_back(no_value);
            continue;
        }
        if (attribute.indices.empty() || place[old] == no_value) {
            place[old] = static_cast<std::uint32_t>(part.value_count());
            const auto value = attribute.values.begin() + static_cast<std::ptrdiff_t>(old * size);
            part.values.insert(part.values.end(), value, value + static_cast<std::ptrdiff_t>(size));
        }
        part.indices.push_back(place[old]);
    }
    if (attribute.indices.empty()) part.indices.clear();
    return part;
}

/// Welded vertices in the order in which the whole's vertices first name them.
std::vector<std::uint32_t> in_order(std::span<const std::uint32_t> kept, const WeldedSurface& surface)
{
    std::vector<bool> missing(surface.count);
    for (const std::uint32_t w : kept) missing[w] = true;
    std::vector<std::uint32_t> ordered;
    for (const std::uint32_t w : surface.surface_of) {
        if (missing[w]) ordered.push_back(w);
        missing[w] = false;
    }
    return ordered;
}

/// The corners at every surface vertex, rising.
class CornersOfVertices {
public:
    CornersOfVertices(std::uint32_t vertex_count, std::span<const Triangle> triangles) : first_(vertex_count + 1ul, 0)
    {
        for (const Triangle& t : triangles)
            for (const std::uint32_t w : t) ++first_[w + 1ul];
        for (std::size_t w = 0; w < vertex_count; ++w) first_[w + 1] += first_[w];
        corners_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t c = 0; c < 3 * triangles.size(); ++c) corners_[next[triangles[c / 3][c % 3]]++] = c;
    }

    /// The first corner of w in a chart; none where w is outside.
    std::optional<std::uint32_t> in_chart(std::uint32_t w, std::span<const std::uint32_t> charts,
                                          std::uint32_t chart) const
    {
        for (std::size_t i = first_[w]; i < first_[w + 1ul]; ++i)
            if (charts[corners_[i] / 3] == chart) return corners_[i];
        return std::nullopt;
    }
    /// The first corner of w, which has one.
    std::uint32_t any(std::uint32_t w) const { return corners_[first_[w]]; }

private:
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> corners_;
};

/// Numbers the vertices that corners are at, and those kept that have no corner, as the file does.
/// vertices: [3T'] of the file.
void name_vertices(const WeldedSurface& surface, std::span<const std::uint32_t> kept,
                   std::span<const std::uint32_t> vertices, SurfacePart& part)
{
    std::vector<bool> needed(surface.surface_of.size()), lonely(surface.count);
    for (const std::uint32_t w : kept) lonely[w] = true;
    for (const std::uint32_t v : vertices) {
        needed[v] = true;
        lonely[surface.surface_of[v]] = false;
    }
    std::vector<std::uint32_t> number(surface.surface_of.size());
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        const std::uint32_t w = surface.surface_of[v];
        if (!needed[v] && !lonely[w]) continue;
        lonely[w] = false;
        number[v] = static_cast<std::uint32_t>(part.wanted.size());
        part.wanted.push_back(w);
        part.vertex_of.push_back(v);
    }
    for (std::size_t c = 0; c < vertices.size(); c += 3)
        part.triangles.push_back({number[vertices[c]], number[vertices[c + 1]], number[vertices[c + 2]]});
}

} // namespace

SurfacePart surface_part(const WeldedSurface& surface, const Appearance& appearance, MatrixView<const double> places,
                         std::span<const std::uint32_t> some)
{
    const std::vector<std::uint32_t> kept = in_order(some, surface);
    std::vector<Triangle> triangles(surface.triangles.begin(), surface.triangles.end());
    for (Triangle& t : triangles)
        for (std::uint32_t& v : t) v = surface.surface_of[v];
    CoarseSurface coarse = coarse_surface(triangles, places, kept);
    SurfacePart result;
    result.triangle_of = std::move(coarse.triangle_of);
    const std::vector<std::uint32_t> charts = charts_of(triangles, wedges_of(surface.triangles, appearance));
    const CornersOfVertices corners(surface.count, triangles);
    std::vector<std::uint32_t> vertices;
    for (std::size_t c = 0; c < 3 * coarse.triangles.size(); ++c) {
        const std::uint32_t from = result.triangle_of[c / 3], w = kept[coarse.triangles[c / 3][c % 3]];
        const std::optional<std::uint32_t> corner = corners.in_chart(w, charts, charts[from]);
        const std::uint32_t there = corner.value_or(corners.any(w));
        vertices.push_back(surface.triangles[there / 3][there % 3]);
        result.corner_of.push_back(corner.value_or(3 * from + static_cast<std::uint32_t>(c % 3)));
    }
    name_vertices(surface, kept, vertices, result);
    return result;
}

Appearance appearance_of(const SurfacePart& part, const Appearance& appearance)
{
    Appearance rest;
    rest.materials = appearance.materials;
    rest.groups = appearance.groups;
    rest.assets = appearance.assets;
    for (const Attribute& attribute : appearance.attributes)
        rest.attributes.push_back(values_of(attribute, attribute.domain == Domain::vertex   ? part.vertex_of
                                                       : attribute.domain == Domain::corner ? part.corner_of
                                                                                            : part.triangle_of));
    return rest;
}

} // namespace meshreel
