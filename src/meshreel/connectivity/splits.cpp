/// Each of the three walks once, for both directions.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/splits.h"

#include <algorithm>

#include "meshreel/coding/model.h"
#include "meshreel/coding/varint.h"

namespace meshreel::connectivity {

namespace {

using coding::Bit;
using coding::NumberModel;

template <class Coder>
bool cut(const Coder& coder)
{
    if constexpr (Coder::writes)
        return false;
    else
        return coder.overrun();
}

Error cut_error(const char* field)
{
    return bad_input("the bytes end too early", field);
}

/// Codes whether anything is welded at all, so that nothing more is said where nothing is.
template <class Coder>
bool code_any(Coder& coder, bool wanted)
{
    Bit any;
    return coder.bit(any, wanted);
}

template <class Coder>
Status code_classes(Coder& coder, std::span<std::uint32_t> class_of)
{
    std::uint32_t met = 0, last = 0;
    for (const std::uint32_t c : class_of) met = std::max(met, c + 1);
    const bool any = code_any(coder, met != class_of.size());
    Bit repeated[8];
    NumberModel jump;
    std::size_t history = 0;
    met = 0;
    for (std::uint32_t& c : class_of) {
        const bool repeat = any && coder.bit(repeated[history], c != met);
        history = (history << 1 | (repeat ? 1u : 0u)) & 7u;
        if (!repeat) {
            c = met++;
            continue;
        }
        const std::int64_t expected = std::int64_t{last} + 1;
        const std::uint64_t folded = jump.code(coder, coding::zigzag(c - expected));
        const std::int64_t found = expected + coding::unzigzag(folded);
        if (cut(coder)) return cut_error("classes");
        if (found < 0 || found >= met) return bad_input("a vertex repeats one that is not yet met", "classes");
        c = last = static_cast<std::uint32_t>(found);
    }
    if (cut(coder)) return cut_error("classes");
    return Ok{};
}

template <class Coder>
Status code_counts(Coder& coder, std::vector<std::uint32_t>& counts, std::uint32_t vertex_count)
{
    const bool any = code_any(coder, counts.size() != vertex_count);
    NumberModel more[2];
    std::uint64_t total = 0;
    std::size_t before = 0;
    for (std::uint32_t& count : counts) {
        const std::uint64_t others = any ? more[before].code(coder, count - 1ul) : 0;
        total += others + 1;
        if (total > vertex_count) return bad_input("more copies than vertices", "copy_counts");
        count = static_cast<std::uint32_t>(others + 1);
        before = others != 0 ? 1 : 0;
        if (cut(coder)) return cut_error("copy_counts");
    }
    if (total != vertex_count) return bad_input("fewer copies than vertices", "copy_counts");
    return Ok{};
}

/// Which copy a corner uses: the one last used here, else the first not yet used, else any.
template <class Coder>
class CornerCoder {
public:
    CornerCoder(Coder& coder, const Members& members)
        : coder_(coder), members_(members), last_(members.begin.size()), used_(members.begin.size())
    {
    }

    /// @param wanted place of the copy among the surface vertex's; a reader's result may be beyond them.
    std::uint32_t code(std::uint32_t surface_vertex, std::uint32_t wanted)
    {
        const auto count = static_cast<std::uint32_t>(members_.of(surface_vertex).size());
        if (count == 1) return 0;
        std::uint32_t& last = last_[surface_vertex];
        std::uint32_t& used = used_[surface_vertex];
        const std::size_t state = used == 0 ? 0 : used < count ? 1 : 2;
        if (used > 0 && coder_.bit(same_[state][misses_], wanted == last)) {
            misses_ = 0;
            return last;
        }
        misses_ = 1;
        std::uint32_t place = used;
        if (used == count || !coder_.bit(fresh_[state], wanted == used))
            place = coder_.raw(wanted, coding::bit_width(count - 1));
        used = std::max(used, std::min(place, count - 1) + 1);
        return last = place;
    }

private:
    Coder& coder_;
    const Members& members_;
    std::vector<std::uint32_t> last_, used_; ///< [W] copy used last; copies below this one have been used
    std::size_t misses_ = 0;                 ///< whether the corner before used another copy than the last triangle
    Bit same_[3][2], fresh_[3];
};

template <class Coder>
Status code_corners(Coder& coder, const Surface& surface, const Members& members, std::span<std::uint32_t> vertex_at)
{
    if (members.all_alone()) {
        for (std::size_t q = 0; q < vertex_at.size(); ++q)
            vertex_at[q] = members.vertices[surface.triangles[q / 3][q % 3]];
        return Ok{};
    }
    CornerCoder<Coder> corners(coder, members);
    for (std::size_t q = 0; q < vertex_at.size(); ++q) {
        const std::uint32_t s = surface.triangles[q / 3][q % 3];
        const std::span<const std::uint32_t> copies = members.of(s);
        std::uint32_t wanted = 0;
        if constexpr (Coder::writes)
            wanted = static_cast<std::uint32_t>(std::lower_bound(copies.begin(), copies.end(), vertex_at[q]) -
                                                copies.begin());
        const std::uint32_t place = corners.code(s, wanted);
        if (place >= copies.size()) return bad_input("a copy that is not there", "corner_copies");
        vertex_at[q] = copies[place];
        if (cut(coder)) return cut_error("corner_copies");
    }
    return Ok{};
}

} // namespace

Members members_of(std::uint32_t surface_vertices, std::span<const std::uint32_t> surface_of)
{
    Members members{std::vector<std::uint32_t>(surface_vertices + 1ul), std::vector<std::uint32_t>(surface_of.size())};
    for (const std::uint32_t s : surface_of) ++members.begin[s + 1];
    for (std::uint32_t s = 0; s < surface_vertices; ++s) members.begin[s + 1] += members.begin[s];
    std::vector<std::uint32_t> end(members.begin.begin(), members.begin.end() - 1);
    for (std::uint32_t v = 0; v < surface_of.size(); ++v) members.vertices[end[surface_of[v]]++] = v;
    return members;
}

void write_classes(coding::RangeEncoder& coder, std::span<const std::uint32_t> class_of)
{
    std::vector<std::uint32_t> same(class_of.begin(), class_of.end());
    (void)code_classes(coder, std::span(same));
}

Result<std::vector<std::uint32_t>> read_classes(coding::RangeDecoder& coder, std::uint32_t vertex_count)
{
    std::vector<std::uint32_t> class_of(vertex_count);
    MESHREEL_CHECK(code_classes(coder, std::span(class_of)));
    return class_of;
}

void write_counts(coding::RangeEncoder& coder, const Members& members)
{
    std::vector<std::uint32_t> counts;
    for (std::size_t s = 0; s + 1 < members.begin.size(); ++s)
        counts.push_back(members.begin[s + 1] - members.begin[s]);
    (void)code_counts(coder, counts, static_cast<std::uint32_t>(members.vertices.size()));
}

Result<Members> read_counts(coding::RangeDecoder& coder, std::uint32_t surface_vertices, std::uint32_t vertex_count)
{
    std::vector<std::uint32_t> counts(surface_vertices);
    MESHREEL_CHECK(code_counts(coder, counts, vertex_count));
    Members members{{0}, std::vector<std::uint32_t>(vertex_count)};
    for (const std::uint32_t count : counts) members.begin.push_back(members.begin.back() + count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) members.vertices[v] = v;
    return members;
}

void write_corners(coding::RangeEncoder& coder, const Surface& surface, const Members& members,
                   std::span<const std::uint32_t> vertex_at)
{
    std::vector<std::uint32_t> same(vertex_at.begin(), vertex_at.end());
    (void)code_corners(coder, surface, members, std::span(same));
}

Result<std::vector<std::uint32_t>> read_corners(coding::RangeDecoder& coder, const Surface& surface,
                                                const Members& members)
{
    std::vector<std::uint32_t> vertex_at(surface.triangles.size() * 3);
    MESHREEL_CHECK(code_corners(coder, surface, members, std::span(vertex_at)));
    return vertex_at;
}

} // namespace meshreel::connectivity
