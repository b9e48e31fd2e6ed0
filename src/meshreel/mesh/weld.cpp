/// Welding by a hash of each trajectory, read frame by frame as it comes.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/weld.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace meshreel {

namespace {

constexpr std::size_t block_size = 4096; ///< vertices that one thread takes at a time

/// Calls body(first, last) for blocks of the vertices.
template <class Body>
void for_vertex_blocks(std::uint32_t vertex_count, Threads threads, const Body& body)
{
    parallel_for((vertex_count + block_size - 1) / block_size, threads, [&](std::size_t b) {
        body(b * block_size, std::min<std::size_t>(vertex_count, (b + 1) * block_size));
    });
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word)
{
    hash = (hash ^ word) * 0xbf58476d1ce4e5b9u;
    return hash ^ (hash >> 29);
}

Result<std::vector<std::uint64_t>> trajectory_hashes(FrameSource& source, const WeldOptions& options)
{
    const std::uint32_t V = source.still().vertex_count;
    std::vector<std::uint64_t> hashes(V, 0x9e3779b97f4a7c15u);
    MESHREEL_CHECK(for_frame_runs(source, [&](std::size_t, MatrixView<const float> frames) -> Status {
        for_vertex_blocks(V, options.threads, [&](std::size_t first, std::size_t last) {
            for (std::size_t f = 0; f < frames.rows; ++f)
                for (std::size_t v = first; v < last; ++v) {
                    std::uint32_t bits[3];
                    std::memcpy(bits, frames.row(f).data() + 3 * v, sizeof bits);
                    hashes[v] = mixed(mixed(hashes[v], bits[0] | std::uint64_t{bits[1]} << 32), bits[2]);
                }
        });
        return Ok{};
    }));
    for (std::uint64_t& hash : hashes) hash &= options.hash_mask;
    return hashes;
}

/// leader[v]: the first vertex whose hash is that of v.
std::vector<std::uint32_t> leaders_by_hash(const std::vector<std::uint64_t>& hashes)
{
    std::vector<std::uint32_t> order(hashes.size()), leader(hashes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return hashes[a] != hashes[b] ? hashes[a] < hashes[b] : a < b; });
    for (std::size_t i = 0; i < order.size(); ++i)
        leader[order[i]] = i > 0 && hashes[order[i]] == hashes[order[i - 1]] ? leader[order[i - 1]] : order[i];
    return leader;
}

/// The vertices whose trajectory is not that of their leader, in rising order.
Result<std::vector<std::uint32_t>> collisions(FrameSource& source, const std::vector<std::uint32_t>& leader,
                                              Threads threads)
{
    std::vector<std::uint8_t> differs(leader.size(), 0);
    MESHREEL_CHECK(for_frame_runs(source, [&](std::size_t, MatrixView<const float> frames) -> Status {
        for_vertex_blocks(source.still().vertex_count, threads, [&](std::size_t first, std::size_t last) {
            for (std::size_t f = 0; f < frames.rows; ++f) {
                const float* frame = frames.row(f).data();
                for (std::size_t v = first; v < last; ++v)
                    if (leader[v] != v && std::memcmp(frame + 3 * v, frame + 3ul * leader[v], 3 * sizeof(float)) != 0)
                        differs[v] = 1;
            }
        });
        return Ok{};
    }));
    std::vector<std::uint32_t> found;
    for (std::uint32_t v = 0; v < differs.size(); ++v)
        if (differs[v]) found.push_back(v);
    return found;
}

/// A vertex, and the class that it shares with those that were where it was in all frames so far.
struct Classed {
    std::uint32_t vertex, number;
};

/// Splits the classes by where the vertices are in one frame.
void split_classes(const float* frame, std::vector<Classed>& all)
{
    const auto order = [&](const Classed& a, const Classed& b) {
        if (a.number != b.number) return a.number < b.number ? -1 : 1;
        return std::memcmp(frame + 3ul * a.vertex, frame + 3ul * b.vertex, 3 * sizeof(float));
    };
    std::stable_sort(all.begin(), all.end(), [&](const Classed& a, const Classed& b) { return order(a, b) < 0; });
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool next = i + 1 < all.size() && order(all[i], all[i + 1]) != 0;
        all[i].number = number;
        number += next ? 1 : 0;
    }
}

/// Gives vertices that share a hash by accident their true leaders: splits them frame by frame.
Status settle(FrameSource& source, const std::vector<std::uint32_t>& vertices, std::vector<std::uint32_t>& leader)
{
    if (vertices.empty()) return Ok{};
    std::vector<Classed> all;
    for (std::uint32_t v : vertices) all.push_back({v, 0});
    MESHREEL_CHECK(for_frame_runs(source, [&](std::size_t, MatrixView<const float> frames) -> Status {
        for (std::size_t f = 0; f < frames.rows; ++f) split_classes(frames.row(f).data(), all);
        return Ok{};
    }));
    std::sort(all.begin(), all.end(), [](const Classed& a, const Classed& b) {
        return a.number != b.number ? a.number < b.number : a.vertex < b.vertex;
    });
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool as_before = i > 0 && all[i].number == all[i - 1].number;
        leader[all[i].vertex] = as_before ? leader[all[i - 1].vertex] : all[i].vertex;
    }
    return Ok{};
}

/// The classes, numbered by first occurrence.
Weld numbered(const std::vector<std::uint32_t>& leader)
{
    Weld result;
    result.unique_of.resize(leader.size());
    for (std::uint32_t v = 0; v < leader.size(); ++v) {
        if (leader[v] == v) {
            result.unique_of[v] = result.unique_count();
            result.first_of.push_back(v);
        } else {
            result.unique_of[v] = result.unique_of[leader[v]];
        }
    }
    return result;
}

} // namespace

Result<Weld> weld(FrameSource& source, const WeldOptions& options)
{
    MESHREEL_TRY(const std::vector<std::uint64_t> hashes, trajectory_hashes(source, options));
    std::vector<std::uint32_t> leader = leaders_by_hash(hashes);
    MESHREEL_TRY(const std::vector<std::uint32_t> found, collisions(source, leader, options.threads));
    MESHREEL_CHECK(settle(source, found, leader));
    return numbered(leader);
}

Weld weld(const Animation& animation, const WeldOptions& options)
{
    HeldFrames source(animation);
    return *weld(source, options); // memory does not fail
}

} // namespace meshreel
