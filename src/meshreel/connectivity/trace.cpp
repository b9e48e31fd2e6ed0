/// The traversal: a stack of half-edges, right before left.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/trace.h"

#include <vector>

#include "meshreel/connectivity/adjacency.h"

namespace meshreel::connectivity {

namespace {

class Walk {
public:
    Walk(std::uint32_t vertex_count, std::span<const Triangle> triangles)
        : mesh_(adjacency(vertex_count, triangles)), visited_(triangles.size()), number_(vertex_count, none)
    {
        trace_.surface.vertex_count = vertex_count;
        trace_.surface.triangles.reserve(triangles.size());
        trace_.surface.gates.reserve(vertex_count);
        trace_.vertex_of.reserve(vertex_count);
        trace_.corner_of.reserve(triangles.size() * 3);
    }

    Trace run()
    {
        for (std::uint32_t t = 0; t < visited_.size(); ++t)
            if (visited_[t] == 0) component(t);
        for (std::uint32_t v = 0; v < number_.size(); ++v) meet(v, {});
        return std::move(trace_);
    }

private:
    void component(std::uint32_t first)
    {
        for (std::uint32_t i = 0; i < 3; ++i) meet(mesh_.triangles[first][i], gate_of_first(mesh_.triangles[first], i));
        enter(first);
        for (std::uint32_t i = 3; i-- > 0;) push(3 * first + i);
        while (!stack_.empty()) {
            const std::uint32_t gate = stack_.back();
            stack_.pop_back();
            if (visited_[gate / 3] == 0) cross(gate);
        }
    }

    /// Known vertices of a component's first triangle: later corners see earlier ones.
    Gate gate_of_first(const Triangle& triangle, std::uint32_t corner) const
    {
        Gate gate;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const VertexId known(number_[triangle[i]]);
            if (i == corner || !known.valid()) continue;
            (gate.left.valid() ? gate.right : gate.left) = known;
        }
        return gate;
    }

    ///          tip
    ///   left  /   \  right     half-edge gate runs from a to b in the triangle above
    ///        a --- b
    void cross(std::uint32_t gate)
    {
        const std::uint32_t right = next_half(gate), left = previous_half(gate);
        const std::uint32_t below = mesh_.twin[gate];
        const VertexId a(number_[mesh_.from(gate)]), b(number_[mesh_.from(right)]);
        meet(mesh_.from(left), {a, b, VertexId(number_[mesh_.from(previous_half(below))])});
        enter(gate / 3);
        push(left);
        push(right);
    }

    /// Gives a vertex its number, unless it has one.
    void meet(std::uint32_t vertex, const Gate& gate)
    {
        if (number_[vertex] != none) return;
        number_[vertex] = static_cast<std::uint32_t>(trace_.vertex_of.size());
        trace_.vertex_of.push_back(vertex);
        trace_.surface.gates.push_back(gate);
    }

    void enter(std::uint32_t t)
    {
        visited_[t] = 1;
        Triangle renumbered;
        for (std::uint32_t i = 0; i < 3; ++i)
            renumbered[mesh_.input_corner(3 * t + i) % 3] = number_[mesh_.triangles[t][i]];
        trace_.surface.triangles.push_back(renumbered);
        for (std::uint32_t i = 0; i < 3; ++i) trace_.corner_of.push_back(3 * t + i);
    }

    void push(std::uint32_t half)
    {
        const std::uint32_t across = mesh_.twin[half];
        if (across != none && visited_[across / 3] == 0) stack_.push_back(across);
    }

    Adjacency mesh_;
    std::vector<std::uint8_t> visited_;
    std::vector<std::uint32_t> number_; ///< [W] surface number of each input vertex
    std::vector<std::uint32_t> stack_;  ///< half-edges of triangles still to enter, the next one last
    Trace trace_;
};

} // namespace

Trace trace(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    return Walk(vertex_count, triangles).run();
}

} // namespace meshreel::connectivity
