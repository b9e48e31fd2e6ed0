/// The room's promises, each for every awkward shape: exact, the same on both sides, safe on foreign bytes.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numeric>

#include "tests/connectivity/shapes.h"

namespace meshreel::connectivity {
namespace {

using Indices = std::vector<std::uint32_t>;

std::vector<std::array<std::uint32_t, 3>> gate_numbers(const Surface& surface)
{
    std::vector<std::array<std::uint32_t, 3>> all;
    for (const Gate& gate : surface.gates) all.push_back({gate.left.value, gate.right.value, gate.opposite.value});
    return all;
}

void expect_same(const Topology& a, const Topology& b)
{
    EXPECT_EQ(a.vertex_count, b.vertex_count);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.surface_of, b.surface_of);
    EXPECT_EQ(a.surface.vertex_count, b.surface.vertex_count);
    EXPECT_EQ(a.surface.triangles, b.surface.triangles);
    EXPECT_EQ(gate_numbers(a.surface), gate_numbers(b.surface));
}

class EveryOrder : public testing::TestWithParam<Order> {};
INSTANTIATE_TEST_SUITE_P(topology, EveryOrder, testing::Values(Order::keep, Order::free, Order::base));

TEST_P(EveryOrder, gives_the_decoder_exactly_what_the_encoder_has)
{
    for (const List& list : every_list()) {
        SCOPED_TRACE(list.name);
        const Encoded encoded = encode(list.input(), GetParam());
        const Result<Topology> decoded = decode(encoded.bytes, list.triangles, {});
        ASSERT_TRUE(decoded) << decoded.error().sentence();
        expect_same(encoded.topology, *decoded);
    }
}

TEST_P(EveryOrder, says_where_every_output_element_came_from)
{
    for (const List& list : every_list()) {
        SCOPED_TRACE(list.name);
        const Encoded e = encode(list.input(), GetParam());
        Indices sorted = e.vertex_of;
        std::sort(sorted.begin(), sorted.end());
        Indices all(list.vertex_count);
        std::iota(all.begin(), all.end(), 0u);
        ASSERT_EQ(sorted, all);
        ASSERT_EQ(e.corner_of.size(), 3 * list.triangles.size());
        for (std::size_t q = 0; q < e.corner_of.size(); ++q) {
            const std::uint32_t c = e.corner_of[q];
            ASSERT_EQ(e.vertex_of[e.topology.triangles[q / 3][q % 3]], list.triangles[c / 3][c % 3]);
            ASSERT_EQ(c / 3, e.corner_of[q - q % 3] / 3);
            ASSERT_EQ(c % 3, (e.corner_of[q - q % 3] + q) % 3) << "orientation";
        }
    }
}

TEST_P(EveryOrder, numbers_the_surface_so_that_gates_hold_earlier_vertices_only)
{
    for (const List& list : every_list()) {
        SCOPED_TRACE(list.name);
        const Topology t = encode(list.input(), GetParam()).topology;
        ASSERT_EQ(t.surface.gates.size(), t.surface.vertex_count);
        for (std::uint32_t v = 0; v < t.surface.vertex_count; ++v)
            for (const VertexId id : {t.surface.gates[v].left, t.surface.gates[v].right, t.surface.gates[v].opposite})
                ASSERT_TRUE(!id.valid() || id.value < v);
        for (std::size_t i = 0; i < t.surface.triangles.size(); ++i)
            for (const std::uint32_t v : t.surface.triangles[i]) ASSERT_LT(v, t.surface.vertex_count);
    }
}

TEST_P(EveryOrder, maps_equal_classes_to_one_surface_vertex)
{
    for (const List& list : every_list()) {
        SCOPED_TRACE(list.name);
        const Encoded e = encode(list.input(), GetParam());
        for (std::uint32_t i = 0; i < list.vertex_count; ++i) {
            const std::uint32_t stands_for_it = e.original_of[e.topology.surface_of[i]];
            const auto class_of = [&](std::uint32_t v) { return list.unique_of.empty() ? v : list.unique_of[v]; };
            ASSERT_EQ(class_of(e.vertex_of[i]), class_of(stands_for_it));
        }
    }
}

TEST(topology, keeps_every_number_by_default)
{
    for (const List& list : every_list()) {
        const Result<Topology> decoded = decode(encode(list.input(), Order::keep).bytes, {});
        ASSERT_TRUE(decoded) << list.name << decoded.error().sentence();
        ASSERT_EQ(decoded->triangles, list.triangles) << list.name;
    }
}

TEST(topology, numbers_vertices_as_the_surface_does_when_the_order_is_free)
{
    const List list = grid(5);
    const Topology t = encode(list.input(), Order::free).topology;
    EXPECT_EQ(t.triangles, t.surface.triangles);
    EXPECT_TRUE(std::is_sorted(t.surface_of.begin(), t.surface_of.end()));
}

TEST(topology, stores_next_to_nothing_when_the_base_mesh_is_given)
{
    const List list = grid(40);
    EXPECT_LE(encode(list.input(), Order::base).bytes.size(), 8u);
}

TEST_P(EveryOrder, refuses_every_truncation_or_still_gives_a_sound_mesh)
{
    for (const List& list : {soup(3), soup(6), grid(6), grid(5, true, true)}) {
        const Bytes bytes = encode(list.input(), GetParam()).bytes;
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            const Result<Topology> decoded = decode(ByteView(bytes).first(size), list.triangles, {});
            EXPECT_TRUE(decoded.ok() || !decoded.error().sentence().empty());
        }
    }
}

TEST_P(EveryOrder, survives_flipped_bytes_within_the_memory_limit)
{
    Random random(9);
    DecodeLimits limits;
    limits.max_memory = 64 << 20;
    for (const List& list : {soup(3), soup(6), grid(6), grid(5, true, true)}) {
        const Bytes good = encode(list.input(), GetParam()).bytes;
        for (int trial = 0; trial < 400; ++trial) {
            Bytes bytes = good;
            for (std::uint64_t flips = 1 + random.below(3); flips > 0; --flips)
                bytes[random.below(bytes.size())] ^= static_cast<std::uint8_t>(1 + random.below(255));
            const Result<Topology> decoded = decode(bytes, list.triangles, limits);
            if (!decoded) continue;
            for (const Triangle& t : decoded->triangles)
                for (const std::uint32_t v : t) ASSERT_LT(v, decoded->vertex_count);
        }
    }
}

TEST(topology, refuses_counts_above_the_limits_before_it_allocates)
{
    const List list = grid(6);
    const Bytes bytes = encode(list.input(), Order::keep).bytes;
    DecodeLimits few;
    few.max_vertices = list.vertex_count - 1;
    EXPECT_EQ(decode(bytes, few).error().field, "vertex_count");
    few = {};
    few.max_triangles = 1;
    EXPECT_EQ(decode(bytes, few).error().field, "triangle_count");
    few = {};
    few.max_memory = 1000;
    EXPECT_FALSE(decode(bytes, few));
}

TEST(topology, names_the_byte_where_a_payload_goes_wrong)
{
    const Bytes unknown_kind = {0xff, 0x01, 1, 1};
    EXPECT_EQ(decode(unknown_kind, {}).error().place->number, 0u);
    EXPECT_EQ(decode(Bytes{}, {}).error().field, "topology_kind");
    const List list = grid(3);
    const Bytes based = encode(list.input(), Order::base).bytes;
    EXPECT_EQ(decode(based, {}).error().field, "base");
}

} // namespace
} // namespace meshreel::connectivity
