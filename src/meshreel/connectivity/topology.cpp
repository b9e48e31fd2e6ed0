/// Puts the payload together: head, classes, mesh, corners.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/topology.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "meshreel/base/text.h"
#include "meshreel/coding/model.h"
#include "meshreel/coding/varint.h"
#include "meshreel/connectivity/adjacency.h"
#include "meshreel/connectivity/reorder.h"
#include "meshreel/connectivity/sequence.h"
#include "meshreel/connectivity/shell.h"
#include "meshreel/connectivity/splits.h"
#include "meshreel/connectivity/trace.h"

namespace meshreel::connectivity {

namespace {

using Indices = std::vector<std::uint32_t>;

/// How the triangle list is written.
enum class Method : std::uint8_t {
    given = 0,    ///< not at all
    shell = 1,    ///< Edgebreaker; numbering lost
    sequence = 2, ///< in its own order
    reordered = 3 ///< Edgebreaker, then the way back to the numbering
};

/// The head of the payload: two bits each for order and method, then the counts.
struct Head {
    Order order = Order::keep;
    Method method = Method::given;
    std::uint64_t vertices = 0, triangles = 0;
};

Indices counting(std::size_t count)
{
    Indices all(count);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

Indices classes_of(const Input& input)
{
    return input.unique_of.empty() ? counting(input.vertex_count)
                                   : Indices(input.unique_of.begin(), input.unique_of.end());
}

std::uint32_t class_count(std::span<const std::uint32_t> class_of)
{
    return class_of.empty() ? 0 : *std::max_element(class_of.begin(), class_of.end()) + 1;
}

std::vector<Triangle> renamed(std::span<const Triangle> triangles, std::span<const std::uint32_t> name)
{
    std::vector<Triangle> all(triangles.begin(), triangles.end());
    for (Triangle& t : all)
        for (std::uint32_t& v : t) v = name[v];
    return all;
}

/// name[i] for every i of `places`.
Indices chosen(std::span<const std::uint32_t> name, std::span<const std::uint32_t> places)
{
    Indices all(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) all[i] = name[places[i]];
    return all;
}

Indices inverse(std::span<const std::uint32_t> permutation)
{
    Indices all(permutation.size());
    for (std::uint32_t i = 0; i < permutation.size(); ++i) all[permutation[i]] = i;
    return all;
}

Bytes with_head(const Head& head, const Bytes& body)
{
    Bytes bytes{static_cast<std::uint8_t>(static_cast<unsigned>(head.order) | static_cast<unsigned>(head.method) << 2)};
    coding::put_varint(bytes, head.vertices);
    coding::put_varint(bytes, head.triangles);
    bytes.insert(bytes.end(), body.begin(), body.end());
    return bytes;
}

/// Appends the vertices that no triangle uses, by number.
void append_unused(Indices& vertex_of, std::uint32_t vertex_count)
{
    std::vector<bool> used(vertex_count);
    for (const std::uint32_t v : vertex_of) used[v] = true;
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        if (!used[v]) vertex_of.push_back(v);
}

/// Order kept or given: all names stay, so only the surface's are made.
Topology named_topology(std::span<const Triangle> triangles, std::span<const std::uint32_t> class_of, Trace& trace)
{
    Topology topology;
    topology.vertex_count = static_cast<std::uint32_t>(class_of.size());
    topology.triangles.assign(triangles.begin(), triangles.end());
    topology.surface_of = chosen(inverse(trace.vertex_of), class_of);
    topology.surface = std::move(trace.surface);
    return topology;
}

/// The triangle list with its numbers in the cheaper of two ways; the coder goes on behind it. The second is not tried
/// where the first needs less than three bits a triangle: such lists are regular, and often large.
Method write_named(coding::RangeEncoder& coder, std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    coding::RangeEncoder sequence = coder;
    write_sequence(sequence, vertex_count, triangles);
    std::optional<Shelled> shelled;
    if (8 * (sequence.size() - coder.size()) > 3 * triangles.size()) shelled = shell_of(vertex_count, triangles);
    Method method = Method::sequence;
    if (shelled) {
        coding::RangeEncoder reordered = coder;
        write(reordered, shelled->shell);
        write_order(reordered, vertex_count, *shelled);
        if (reordered.size() < sequence.size()) {
            sequence = std::move(reordered);
            method = Method::reordered;
        }
    }
    coder = std::move(sequence);
    return method;
}

Encoded encode_named(const Input& input, Order order)
{
    const Indices class_of = classes_of(input);
    const std::uint32_t classes = class_count(class_of);
    const std::vector<Triangle> triangles = renamed(input.triangles, class_of);
    Encoded result;
    Trace traced = trace(classes, triangles);
    coding::RangeEncoder coder;
    write_classes(coder, class_of);
    Head head{order, Method::given, input.vertex_count, input.triangles.size()};
    if (order == Order::keep) head.method = write_named(coder, classes, triangles);
    const Members originals = members_of(classes, class_of);
    for (const std::uint32_t c : traced.vertex_of) result.original_of.push_back(originals.of(c)[0]);
    const Indices corner_of = traced.corner_of;
    result.topology = named_topology(input.triangles, class_of, traced);
    if (order == Order::keep) {
        const Members members = members_of(classes, result.topology.surface_of);
        Indices vertex_at;
        for (const std::uint32_t c : corner_of) vertex_at.push_back(input.triangles[c / 3][c % 3]);
        write_corners(coder, result.topology.surface, members, vertex_at);
    }
    result.bytes = with_head(head, coder.finish());
    result.vertex_of = counting(input.vertex_count);
    result.corner_of = counting(3 * input.triangles.size());
    return result;
}

/// Order free: fills everything the two directions share from the members and the output vertex at each corner.
Topology free_topology(Surface surface, const Members& members, const Indices& vertex_at)
{
    Topology topology;
    topology.vertex_count = static_cast<std::uint32_t>(members.vertices.size());
    for (std::uint32_t s = 0; s < surface.vertex_count; ++s)
        topology.surface_of.insert(topology.surface_of.end(), members.of(s).size(), s);
    topology.triangles.resize(surface.triangles.size());
    for (std::size_t q = 0; q < vertex_at.size(); ++q) topology.triangles[q / 3][q % 3] = vertex_at[q];
    topology.surface = std::move(surface);
    return topology;
}

/// The list as the decoder will have it, and where it came from.
struct Listed {
    std::vector<Triangle> triangles;
    Indices vertex_of, corner_of;
};

Listed write_unnamed(coding::RangeEncoder& coder, std::uint32_t vertex_count, std::vector<Triangle> triangles,
                     Method& method)
{
    std::optional<Shelled> shelled = shell_of(vertex_count, triangles);
    method = shelled ? Method::shell : Method::sequence;
    if (!shelled) { // so many handles that Edgebreaker would keep the decoder too busy
        write_sequence(coder, vertex_count, triangles);
        const std::size_t corners = 3 * triangles.size();
        return {std::move(triangles), counting(vertex_count), counting(corners)};
    }
    write(coder, shelled->shell);
    Listed listed{*triangles_of(shelled->shell), std::move(shelled->vertex_of), std::move(shelled->corner_of)};
    append_unused(listed.vertex_of, vertex_count);
    return listed;
}

Encoded encode_free(const Input& input)
{
    const Indices class_of = classes_of(input);
    const std::uint32_t classes = class_count(class_of);
    coding::RangeEncoder coder;
    coding::NumberModel repeats;
    repeats.code(coder, input.vertex_count - classes);
    Head head{Order::free, Method::shell, input.vertex_count, input.triangles.size()};
    const Listed listed = write_unnamed(coder, classes, renamed(input.triangles, class_of), head.method);
    Trace traced = trace(classes, listed.triangles);
    Encoded result;
    const Indices class_at = chosen(listed.vertex_of, traced.vertex_of);
    const Indices surface_of = chosen(inverse(class_at), class_of);
    const Members originals = members_of(classes, surface_of); // original vertices, surface vertex by surface vertex
    write_counts(coder, originals);
    result.vertex_of = originals.vertices;
    result.corner_of = chosen(listed.corner_of, traced.corner_of);
    for (std::uint32_t s = 0; s < classes; ++s) result.original_of.push_back(originals.of(s)[0]);
    const Members members{originals.begin, counting(input.vertex_count)};
    const Indices output_of = inverse(originals.vertices);
    Indices vertex_at;
    for (const std::uint32_t c : result.corner_of) vertex_at.push_back(output_of[input.triangles[c / 3][c % 3]]);
    write_corners(coder, traced.surface, members, vertex_at);
    result.topology = free_topology(std::move(traced.surface), members, vertex_at);
    result.bytes = with_head(head, coder.finish());
    return result;
}

Result<Head> read_head(coding::VarintReader& bytes, const DecodeLimits& limits)
{
    MESHREEL_TRY(const std::uint64_t kind, bytes.number("topology_kind"));
    Head head;
    head.order = static_cast<Order>(kind & 3);
    head.method = static_cast<Method>(kind >> 2 & 3);
    const bool named = head.method == Method::sequence || head.method == Method::reordered;
    const bool fits = head.order == Order::base   ? head.method == Method::given
                      : head.order == Order::keep ? named
                                                  : head.method == Method::shell || head.method == Method::sequence;
    if (kind > 15 || head.order > Order::base || !fits)
        return bad_input(concat(kind, " is no kind of topology"), "topology_kind", at_byte(0));
    MESHREEL_TRY(head.vertices, bytes.number("vertex_count"));
    MESHREEL_TRY(head.triangles, bytes.number("triangle_count"));
    constexpr std::uint64_t addressable = 0xffffffffu / 12 - 1; // half-edges of a closed mesh have 32-bit numbers
    MESHREEL_CHECK(within(head.vertices, std::min<std::uint64_t>(limits.max_vertices, 0xfffffff0u), "vertex_count"));
    MESHREEL_CHECK(within(head.triangles, std::min(limits.max_triangles, addressable), "triangle_count"));
    return head;
}

/// Bytes held at most while decoding, per element; measured from the containers of this room.
constexpr std::uint64_t bytes_a_vertex = 100, bytes_a_triangle = 180, bytes_a_closed_triangle = 70;

Status enough_memory(const Head& head, const DecodeLimits& limits)
{
    const std::uint64_t bytes = head.vertices * bytes_a_vertex + head.triangles * bytes_a_triangle;
    if (bytes <= limits.max_memory) return Ok{};
    return bad_input(concat("its connectivity does not fit in the memory limit of ", limits.max_memory, " bytes"),
                     "triangle_count");
}

std::uint64_t most_closed(const Head& head, const DecodeLimits& limits)
{
    return (limits.max_memory - head.vertices * bytes_a_vertex - head.triangles * bytes_a_triangle) /
           bytes_a_closed_triangle;
}

Result<std::vector<Triangle>> read_list(coding::RangeDecoder& coder, const Head& head, std::uint32_t vertex_count,
                                        std::uint64_t closed_limit)
{
    const auto triangle_count = static_cast<std::uint32_t>(head.triangles);
    if (head.method == Method::sequence) return read_sequence(coder, vertex_count, triangle_count);
    MESHREEL_TRY(const Shell shell, read(coder, triangle_count, closed_limit));
    const auto used = static_cast<std::size_t>(std::count(shell.copies.begin(), shell.copies.end(), Shell::fresh));
    if (used > vertex_count) return bad_input("more vertices than announced", "copies");
    MESHREEL_TRY(std::vector<Triangle> list, triangles_of(shell));
    if (head.method == Method::reordered) return read_order(coder, vertex_count, list);
    return list;
}

Result<Topology> decode_free(coding::RangeDecoder& coder, const Head& head, const DecodeLimits& limits)
{
    const auto vertex_count = static_cast<std::uint32_t>(head.vertices);
    coding::NumberModel repeats;
    const std::uint64_t repeated = repeats.code(coder, 0);
    if (repeated > vertex_count) return bad_input("more repeated vertices than vertices", "repeats");
    const std::uint32_t classes = vertex_count - static_cast<std::uint32_t>(repeated);
    MESHREEL_TRY(const std::vector<Triangle> list, read_list(coder, head, classes, most_closed(head, limits)));
    Trace traced = trace(classes, list);
    MESHREEL_TRY(const Members members, read_counts(coder, classes, vertex_count));
    MESHREEL_TRY(const Indices vertex_at, read_corners(coder, traced.surface, members));
    return free_topology(std::move(traced.surface), members, vertex_at);
}

Result<Topology> decode_keep(coding::RangeDecoder& coder, const Head& head, const DecodeLimits& limits)
{
    MESHREEL_TRY(const Indices class_of, read_classes(coder, static_cast<std::uint32_t>(head.vertices)));
    const std::uint32_t classes = class_count(class_of);
    MESHREEL_TRY(std::vector<Triangle> list, read_list(coder, head, classes, most_closed(head, limits)));
    Trace traced = trace(classes, list);
    const Indices corner_of = std::move(traced.corner_of);
    Topology topology = named_topology(list, class_of, traced);
    const Members members = members_of(classes, topology.surface_of);
    MESHREEL_TRY(const Indices vertex_at, read_corners(coder, topology.surface, members));
    for (std::size_t q = 0; q < vertex_at.size(); ++q)
        topology.triangles[corner_of[q] / 3][corner_of[q] % 3] = vertex_at[q];
    return topology;
}

Result<Topology> decode_base(coding::RangeDecoder& coder, const Head& head, std::span<const Triangle> base)
{
    if (base.size() != head.triangles)
        return bad_input(concat("the base mesh has ", base.size(), " triangles, the file ", head.triangles), "base");
    for (const Triangle& t : base)
        if (*std::max_element(t.begin(), t.end()) >= head.vertices)
            return bad_input(concat("the base mesh uses more than the file's ", head.vertices, " vertices"), "base");
    MESHREEL_TRY(const Indices class_of, read_classes(coder, static_cast<std::uint32_t>(head.vertices)));
    Trace traced = trace(class_count(class_of), renamed(base, class_of));
    return named_topology(base, class_of, traced);
}

} // namespace

Encoded encode(const Input& input, Order order)
{
    return order == Order::free ? encode_free(input) : encode_named(input, order);
}

Result<Topology> decode(ByteView bytes, std::span<const Triangle> base, const DecodeLimits& limits)
{
    coding::VarintReader front(bytes);
    MESHREEL_TRY(const Head head, read_head(front, limits));
    MESHREEL_CHECK(enough_memory(head, limits));
    coding::RangeDecoder coder(front.rest());
    Result<Topology> topology = head.order == Order::free   ? decode_free(coder, head, limits)
                                : head.order == Order::keep ? decode_keep(coder, head, limits)
                                                            : decode_base(coder, head, base);
    if (topology.ok()) return topology;
    Error error = std::move(topology).error();
    if (!error.place) error.place = at_byte(front.offset() + coder.position());
    return error;
}

Result<Topology> decode(ByteView bytes, const DecodeLimits& limits)
{
    return decode(bytes, {}, limits);
}

} // namespace meshreel::connectivity
