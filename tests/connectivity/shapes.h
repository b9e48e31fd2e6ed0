/// Triangle lists for this room's tests: every awkward shape, and soups without any order.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "meshreel/base/random.h"
#include "meshreel/connectivity/topology.h"
#include "meshreel/mesh/test_shapes.h"
#include "meshreel/mesh/weld.h"

namespace meshreel::connectivity {

struct List {
    std::string name;
    std::uint32_t vertex_count = 0;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> unique_of = {};

    Input input() const { return {vertex_count, triangles, unique_of}; }
};

/// Random triangles over few vertices: every kind of defect at once.
inline List soup(std::uint64_t seed)
{
    Random random(seed);
    List list{"soup " + std::to_string(seed), static_cast<std::uint32_t>(1 + random.below(30)), {}};
    list.triangles.resize(random.below(80));
    for (Triangle& t : list.triangles)
        for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.below(list.vertex_count));
    if (seed % 2 == 0) return list;
    std::uint32_t classes = 0;
    for (std::uint32_t v = 0; v < list.vertex_count; ++v) {
        const bool fresh = classes == 0 || random.below(3) != 0;
        list.unique_of.push_back(fresh ? classes++ : static_cast<std::uint32_t>(random.below(classes)));
    }
    return list;
}

/// An n x n grid of squares, rolled up into a torus if asked, its triangles in random order if asked.
inline List grid(std::uint32_t n, bool torus = false, bool shuffled = false)
{
    List list{"grid " + std::to_string(n), torus ? n * n : (n + 1) * (n + 1), {}};
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return torus ? i % n * n + j % n : i * (n + 1) + j; };
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            list.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            list.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    Random random(n);
    for (std::size_t t = list.triangles.size(); shuffled && t > 1; --t)
        std::swap(list.triangles[t - 1], list.triangles[random.below(t)]);
    return list;
}

inline std::vector<List> every_list()
{
    std::vector<List> lists;
    for (const test_shapes::Named& shape : test_shapes::all())
        lists.push_back(
            {shape.name, shape.animation.vertex_count, shape.animation.triangles, weld(shape.animation).unique_of});
    for (std::uint64_t seed = 0; seed < 200; ++seed) lists.push_back(soup(seed));
    for (const bool torus : {false, true})
        for (const bool shuffled : {false, true}) lists.push_back(grid(9, torus, shuffled));
    lists.push_back({"nothing", 0, {}});
    return lists;
}

} // namespace meshreel::connectivity
