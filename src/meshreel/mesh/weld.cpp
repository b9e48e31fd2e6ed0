/// Welding by a hash of each trajectory, read frame by frame as it lies in memory.
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

std::vector<std::uint64_t> trajectory_hashes(const Animation& animation, const WeldOptions& options)
{
    std::vector<std::uint64_t> hashes(animation.vertex_count, 0x9e3779b97f4a7c15u);
    for_vertex_blocks(animation.vertex_count, options.threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = 0; f < animation.frame_count(); ++f)
            for (std::size_t v = first; v < last; ++v) {
                std::uint32_t bits[3];
                std::memcpy(bits, animation.frame(f).data() + 3 * v, sizeof bits);
                hashes[v] = mixed(mixed(hashes[v], bits[0] | std::uint64_t{bits[1]} << 32), bits[2]);
            }
        for (std::size_t v = first; v < last; ++v) hashes[v] &= options.hash_mask;
    });
    return hashes;
}

/// Negative, zero or positive as the trajectory of vertex a comes before, equals or comes after that of b.
int compare_trajectories(const Animation& animation, std::uint32_t a, std::uint32_t b)
{
    for (std::size_t f = 0; f < animation.frame_count(); ++f) {
        const float* frame = animation.frame(f).data();
        if (const int order = std::memcmp(frame + 3ul * a, frame + 3ul * b, 3 * sizeof(float))) return order;
    }
    return 0;
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
std::vector<std::uint32_t> collisions(const Animation& animation, const std::vector<std::uint32_t>& leader,
                                      Threads threads)
{
    std::vector<std::uint8_t> differs(leader.size(), 0);
    for_vertex_blocks(animation.vertex_count, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = 0; f < animation.frame_count(); ++f) {
            const float* frame = animation.frame(f).data();
            for (std::size_t v = first; v < last; ++v)
                if (leader[v] != v && std::memcmp(frame + 3 * v, frame + 3ul * leader[v], 3 * sizeof(float)) != 0)
                    differs[v] = 1;
        }
    });
    std::vector<std::uint32_t> found;
    for (std::uint32_t v = 0; v < differs.size(); ++v)
        if (differs[v]) found.push_back(v);
    return found;
}

/// Gives vertices that share a hash by accident their true leaders: sorts their trajectories.
void settle(const Animation& animation, std::vector<std::uint32_t> vertices, std::vector<std::uint32_t>& leader)
{
    std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int order = compare_trajectories(animation, a, b);
        return order != 0 ? order < 0 : a < b;
    });
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const bool as_before = i > 0 && compare_trajectories(animation, vertices[i], vertices[i - 1]) == 0;
        leader[vertices[i]] = as_before ? leader[vertices[i - 1]] : vertices[i];
    }
}

} // namespace

Weld weld(const Animation& animation, const WeldOptions& options)
{
    std::vector<std::uint32_t> leader = leaders_by_hash(trajectory_hashes(animation, options));
    settle(animation, collisions(animation, leader, options.threads), leader);
    Weld result;
    result.unique_of.resize(animation.vertex_count);
    for (std::uint32_t v = 0; v < animation.vertex_count; ++v) {
        if (leader[v] == v) {
            result.unique_of[v] = result.unique_count();
            result.first_of.push_back(v);
        } else {
            result.unique_of[v] = result.unique_of[leader[v]];
        }
    }
    return result;
}

} // namespace meshreel
