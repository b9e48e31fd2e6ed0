/// A tiny file for the tests, made of everything that a container may hold.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "meshreel/base/random.h"
#include "meshreel/container/package.h"

namespace meshreel::container {

/// A grid of n x n vertices, two triangles a cell.
inline std::vector<Triangle> grid(std::uint32_t n)
{
    std::vector<Triangle> triangles;
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t a = y * n + x, b = a + 1, c = a + n, d = c + 1;
            triangles.push_back({a, b, d});
            triangles.push_back({a, d, c});
        }
    return triangles;
}

inline Bytes random_bytes(std::size_t size, std::uint64_t seed)
{
    Random random(seed);
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
    return bytes;
}

/// A square of four vertices and two triangles in three frames; connectivity and codec bytes are made up.
struct Clip {
    Header header{"none", 4, 4, 2, 3, Order::keep, 0, "meshreel 0.1.0"};
    std::vector<Triangle> triangles = grid(2);
    std::vector<double> times_s = uniform_times(3, 24);
    Metadata meta{"wave", true, Axis::y, 0.01, 24};
    Appearance appearance;
    Bytes connectivity = {0xc0, 0x0c}, frames = {0xf0, 0x0f, 0xff};

    Clip()
    {
        appearance.attributes.push_back({"color0", Domain::vertex, Scalar::u8, 1, true, {9, 200, 3, 77}, {}});
        appearance.materials = {"skin", "cloth"};
        appearance.groups = {"all"};
        appearance.assets.push_back({"a.txt", "text/plain", {'h', 'i'}});
    }
    MeshShape mesh() const { return {header.vertex_count, triangles}; }
    /// The chunks, without an end: for tests that add more.
    MemoryWriter writer() const
    {
        MemoryWriter file;
        EXPECT_TRUE(add_head(file, header, times_s, meta).ok());
        file.add(type::conn, ByteView(connectivity));
        EXPECT_TRUE(add_appearance(file, appearance, mesh()).ok());
        EXPECT_TRUE(file.add(type::segm, Segment{0, 2, frames}).ok());
        EXPECT_TRUE(file.add(type::segm, Segment{2, header.frame_count - 2, frames}).ok());
        return file;
    }
    Bytes file() const { return writer().finish(); }
};

} // namespace meshreel::container
