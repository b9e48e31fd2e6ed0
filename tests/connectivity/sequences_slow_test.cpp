/// The room on real sequences and on a large grid: sizes, limits, time. `--gtest_filter=*table*` prints the table.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "meshreel/connectivity/shell.h"
#include "tests/connectivity/shapes.h"

namespace meshreel::connectivity {
namespace {

/// The triangles of ../shared/data/NAME/mesh.obj; empty where there is no such file.
List sequence(const std::string& name)
{
    List list{name, 0, {}};
    std::ifstream file(MESHREEL_SOURCE_DIR "/../shared/data/" + name + "/mesh.obj");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("v ", 0) == 0) ++list.vertex_count;
        if (line.rfind("f ", 0) != 0) continue;
        std::istringstream words(line.substr(2));
        Triangle t{};
        for (std::uint32_t& v : t) {
            std::string word;
            words >> word;
            v = static_cast<std::uint32_t>(std::stoul(word)) - 1;
        }
        list.triangles.push_back(t);
    }
    return list;
}

const std::vector<std::string> names = {"bone",    "chicken", "cloth",        "cow",   "crane", "dance",
                                        "dolphin", "flag",    "horse_gallop", "snake", "walker"};

double bits_a_vertex(const List& list, Order order)
{
    return 8.0 * static_cast<double>(encode(list.input(), order).bytes.size()) / list.vertex_count;
}

TEST(sequences, table_of_sizes)
{
    std::printf("%-13s %6s %6s %9s %10s %10s %10s %6s\n", "", "W", "T", "raw b/t", "free b/t", "free b/v", "keep +b/v",
                "limit");
    int found = 0;
    for (const std::string& name : names) {
        const List list = sequence(name);
        if (list.vertex_count == 0) continue;
        ++found;
        const auto raw = static_cast<double>(shell_of(list.vertex_count, list.triangles)->shell.string.raw_bits());
        const auto triangles = static_cast<double>(list.triangles.size());
        const double free = bits_a_vertex(list, Order::free), keep = bits_a_vertex(list, Order::keep);
        std::printf("%-13s %6u %6.0f %9.3f %10.3f %10.3f %10.2f %6.0f\n", name.c_str(), list.vertex_count, triangles,
                    raw / triangles, free * list.vertex_count / triangles, free, keep - free,
                    std::ceil(std::log2(list.vertex_count)));
    }
    if (found == 0) GTEST_SKIP() << "no ../shared/data";
}

TEST(sequences, dance_takes_at_most_two_bits_a_triangle_raw_and_far_below_after_entropy_coding)
{
    const List dance = sequence("dance");
    if (dance.vertex_count == 0) GTEST_SKIP() << "no ../shared/data/dance";
    const double triangles = static_cast<double>(dance.triangles.size());
    EXPECT_LE(shell_of(dance.vertex_count, dance.triangles)->shell.string.raw_bits(), 2 * dance.triangles.size());
    EXPECT_LE(bits_a_vertex(dance, Order::free) * dance.vertex_count / triangles, 0.75);
}

TEST(sequences, keep_their_order_within_log2_V_bits_a_vertex_where_the_list_has_any_system)
{
    for (const char* name : {"cloth", "cow", "dance", "dolphin", "flag", "horse_gallop", "snake"}) {
        const List list = sequence(name);
        if (list.vertex_count == 0) GTEST_SKIP() << "no ../shared/data/" << name;
        const double extra = bits_a_vertex(list, Order::keep) - bits_a_vertex(list, Order::free);
        EXPECT_LE(extra, std::ceil(std::log2(list.vertex_count))) << name;
    }
}

TEST(sequences, come_back_exact_in_every_order)
{
    for (const std::string& name : names) {
        const List list = sequence(name);
        if (list.vertex_count == 0) GTEST_SKIP() << "no ../shared/data/" << name;
        for (const Order order : {Order::keep, Order::free}) {
            const Encoded encoded = encode(list.input(), order);
            const Result<Topology> decoded = decode(encoded.bytes, {});
            ASSERT_TRUE(decoded) << name;
            ASSERT_EQ(decoded->triangles, encoded.topology.triangles) << name;
            ASSERT_TRUE(order == Order::free || decoded->triangles == list.triangles) << name;
        }
    }
}

TEST(topology, takes_a_million_triangles_in_seconds)
{
    const List list = grid(707);
    for (const Order order : {Order::keep, Order::free}) {
        const auto start = std::chrono::steady_clock::now();
        const Encoded encoded = encode(list.input(), order);
        const auto middle = std::chrono::steady_clock::now();
        ASSERT_TRUE(decode(encoded.bytes, {}));
        const std::chrono::duration<double> writing = middle - start,
                                            reading = std::chrono::steady_clock::now() - middle;
        RecordProperty(order == Order::keep ? "keep_s" : "free_s",
                       std::to_string(writing.count()) + " " + std::to_string(reading.count()));
        EXPECT_LT(reading.count(), 60.0); // a floor for busy machines and sanitizers
    }
}

} // namespace
} // namespace meshreel::connectivity
