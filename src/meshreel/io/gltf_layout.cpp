/// Sorts triangles into primitives and vertices into the sets that they share.
// SPDX-License-Identifier: MIT
#include "meshreel/io/gltf_layout.h"

#include <algorithm>
#include <array>
#include <map>

#include "meshreel/base/check.h"
#include "meshreel/io/attributes.h"
#include "meshreel/io/gltf_names.h"

namespace meshreel::io {

namespace {

using Numbers32 = std::vector<std::uint32_t>;
using Key = std::array<std::uint32_t, 2>; ///< group, material

/// Which primitives share a vertex, directly or by way of others.
struct Union {
    Numbers32 parent;

    std::uint32_t root(std::uint32_t i)
    {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = root(a);
        b = root(b);
        parent[std::max(a, b)] = std::min(a, b);
    }
};

/// The primitive of each triangle, and the key of each primitive.
struct Sorting {
    Numbers32 primitive_of; ///< [T]
    std::vector<Key> keys;
};

Sorting sort_triangles(const Animation& animation)
{
    const Attribute* groups = animation.appearance.find("group");
    const Attribute* materials = animation.appearance.find("material");
    const auto number = [](const Attribute* attribute, std::size_t t, std::size_t count) {
        const bool usable =
            attribute != nullptr && attribute->domain == Domain::triangle && attribute->type != Scalar::f32;
        const std::uint32_t found = usable ? triangle_number(*attribute, t) : no_value;
        return found < count ? found : no_value;
    };
    Sorting sorting;
    std::map<Key, std::uint32_t> known;
    for (std::size_t t = 0; t < animation.triangles.size(); ++t) {
        const Key key = {number(groups, t, animation.appearance.groups.size()),
                         number(materials, t, animation.appearance.materials.size())};
        const auto [place, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(sorting.keys.size()));
        if (fresh) sorting.keys.push_back(key);
        sorting.primitive_of.push_back(place->second);
    }
    return sorting;
}

/// The set of each vertex: sets are numbered by their first primitive.
struct Sets {
    Numbers32 of_vertex;
    Numbers32 of_primitive;
    std::size_t count = 0;
};

Sets share_vertices(const Animation& animation, const Sorting& sorting)
{
    Union shared;
    for (std::uint32_t p = 0; p < sorting.keys.size(); ++p) shared.parent.push_back(p);
    Numbers32 primitive_of_vertex(animation.vertex_count, no_value);
    for (std::size_t t = 0; t < animation.triangles.size(); ++t)
        for (std::uint32_t v : animation.triangles[t]) {
            std::uint32_t& owner = primitive_of_vertex[v];
            if (owner == no_value) owner = sorting.primitive_of[t];
            shared.join(owner, sorting.primitive_of[t]);
        }
    Sets sets;
    Numbers32 number(sorting.keys.size(), no_value);
    for (std::uint32_t p = 0; p < sorting.keys.size(); ++p) {
        std::uint32_t& set = number[shared.root(p)];
        if (set == no_value) set = static_cast<std::uint32_t>(sets.count++);
        sets.of_primitive.push_back(set);
    }
    std::uint32_t last = no_value;
    for (std::uint32_t owner : primitive_of_vertex)
        if (owner != no_value && last == no_value) last = sets.of_primitive[owner];
    for (std::uint32_t owner : primitive_of_vertex) {
        if (owner != no_value) last = sets.of_primitive[owner];
        sets.of_vertex.push_back(last);
    }
    return sets;
}

/// The corners of each vertex, in order: those of vertex v are list[start[v]] .. list[start[v + 1] - 1].
struct CornersOf {
    Numbers32 start, list;
};

CornersOf corners_of_vertices(const Animation& animation)
{
    CornersOf corners;
    corners.start.assign(animation.vertex_count + 1ul, 0);
    corners.list.resize(animation.triangles.size() * 3);
    for (const Triangle& triangle : animation.triangles)
        for (std::uint32_t v : triangle) ++corners.start[v + 1ul];
    for (std::size_t v = 0; v < animation.vertex_count; ++v) corners.start[v + 1] += corners.start[v];
    Numbers32 next(corners.start.begin(), corners.start.end() - 1);
    for (std::uint32_t c = 0; c < corners.list.size(); ++c) corners.list[next[animation.triangles[c / 3][c % 3]]++] = c;
    return corners;
}

std::vector<const Attribute*> corner_attributes(const Animation& animation)
{
    std::vector<const Attribute*> found;
    for (const Attribute& attribute : animation.appearance.attributes)
        if (attribute.domain == Domain::corner && attribute_semantic(attribute.name)) found.push_back(&attribute);
    return found;
}

/// The first of the corners with the same values of all the attributes, for each corner of one vertex.
void find_splits(const Animation& animation, std::span<const Attribute* const> attributes,
                 std::span<const std::uint32_t> corners, Numbers32& first_of)
{
    std::map<Numbers32, std::uint32_t> known;
    for (std::uint32_t c : corners) {
        first_of[c] = corners.front();
        if (attributes.empty()) continue;
        Numbers32 values;
        for (const Attribute* attribute : attributes) values.push_back(corner_value(*attribute, animation, c));
        first_of[c] = known.try_emplace(std::move(values), c).first->second;
    }
}

void fill_sets(const Animation& animation, const Sorting& sorting, const Sets& sets, GltfLayout& layout)
{
    const CornersOf corners = corners_of_vertices(animation);
    const std::vector<const Attribute*> attributes = corner_attributes(animation);
    Numbers32 first_of(corners.list.size()), place(corners.list.size());
    for (std::uint32_t v = 0; v < animation.vertex_count; ++v) {
        GltfVertexSet& set = layout.sets[sets.of_vertex[v]];
        const std::span<const std::uint32_t> own(corners.list.data() + corners.start[v],
                                                 corners.start[v + 1ul] - corners.start[v]);
        find_splits(animation, attributes, own, first_of);
        for (std::uint32_t c : own) {
            place[c] = first_of[c] == c ? static_cast<std::uint32_t>(set.sources.size()) : place[first_of[c]];
            if (first_of[c] != c) continue;
            set.sources.push_back(v);
            set.corners.push_back(c);
        }
        if (!own.empty()) continue;
        set.sources.push_back(v);
        set.corners.push_back(no_corner);
    }
    for (std::size_t c = 0; c < place.size(); ++c)
        layout.primitives[sorting.primitive_of[c / 3]].indices.push_back(place[c]);
}

void name_nodes(const Animation& animation, const Sorting& sorting, GltfLayout& layout)
{
    std::map<std::pair<std::string, std::size_t>, std::size_t> known;
    for (std::size_t p = 0; p < sorting.keys.size(); ++p) {
        const std::uint32_t group = sorting.keys[p][0];
        const GltfGroup named = group == no_value ? GltfGroup{animation.meta.name, 0, animation.meta.name, 0}
                                                  : parse_group(animation.appearance.groups[group]);
        const auto [place, fresh] = known.try_emplace({named.node, named.instance}, layout.nodes.size());
        if (fresh) layout.nodes.push_back({named.node, named.mesh, {}});
        layout.nodes[place->second].primitives.push_back(p);
    }
}

} // namespace

GltfLayout gltf_layout(const Animation& animation)
{
    require(!animation.triangles.empty(), "gltf_layout needs a triangle");
    const Sorting sorting = sort_triangles(animation);
    const Sets sets = share_vertices(animation, sorting);
    GltfLayout layout;
    layout.sets.resize(sets.count);
    layout.primitives.resize(sorting.keys.size());
    for (std::size_t p = 0; p < sorting.keys.size(); ++p) {
        layout.primitives[p].set = sets.of_primitive[p];
        layout.primitives[p].material = sorting.keys[p][1];
    }
    fill_sets(animation, sorting, sets, layout);
    name_nodes(animation, sorting, layout);
    return layout;
}

} // namespace meshreel::io
