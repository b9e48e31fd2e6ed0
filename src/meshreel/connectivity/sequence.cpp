/// Candidates for each corner, ordered by what proved right before; a mixture of models judges each.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/sequence.h"

#include <algorithm>
#include <array>

#include "meshreel/coding/model.h"
#include "meshreel/coding/varint.h"
#include "meshreel/connectivity/adjacency.h"
#include "meshreel/connectivity/judge.h"
#include "meshreel/connectivity/rank_set.h"

namespace meshreel::connectivity {

namespace {

/// What a candidate is. x' and x'' are the triangles one and two before, x the corners of this one known so far.
enum Kind : std::uint8_t {
    next_unseen,     ///< the lowest number not yet used
    after_last_new,  ///< one above the vertex that was new last
    before_last_new, ///< one below
    same_step_1,     ///< as far from the corner before as in x' (first corner: as x' from x'')
    same_step_2,     ///< the like, two triangles ago
    same_span_1,     ///< as far from x_0 as in x'; first corner: one above x'_0
    same_span_2,     ///< as far from x_0 as in x''; first corner: one below x'_0
    previous_0,      ///< x'_0
    previous_1,
    previous_2,
    older_0, ///< x''_0
    older_1,
    older_2,
    open_into,       ///< begin of an open edge into the corner before
    open_out_of,     ///< end of an open edge out of the corner before
    open_into_first, ///< likewise at x_0; first corner: one above x''_0
    open_out_of_first,
    kinds,
    escape = kinds
};

/// What both sides remember of the triangles so far.
class History {
public:
    explicit History(std::uint32_t vertex_count)
        : vertex_count_(vertex_count), seen_(vertex_count), into_(vertex_count, none), out_of_(vertex_count, none)
    {
    }

    std::uint32_t vertex_count() const { return vertex_count_; }
    bool seen(std::uint32_t v) const { return seen_[v]; }
    std::uint32_t last_new() const { return last_new_; }
    std::uint32_t next_unseen() const { return next_unseen_; }
    const Triangle& back(std::size_t n) const { return past_[n - 1]; }

    /// A candidate for corner `j`; may be out of range.
    std::uint32_t candidate(std::uint8_t kind, const Triangle& x, std::uint32_t j) const
    {
        if (kind >= previous_0 && kind <= older_2) return past_[(kind - previous_0) / 3u][(kind - previous_0) % 3u];
        if (kind == Kind::next_unseen) return next_unseen_;
        if (kind <= before_last_new) return kind == after_last_new ? last_new_ + 1 : last_new_ - 1;
        return j == 0 ? first_candidate(kind) : later_candidate(kind, x, j);
    }

    void met(std::uint32_t v)
    {
        if (seen_[v]) return;
        seen_[v] = true;
        last_new_ = v;
        while (next_unseen_ < vertex_count_ && seen_[next_unseen_]) ++next_unseen_;
    }
    void add(const Triangle& t)
    {
        for (std::size_t i = 0; i < 3; ++i) add_edge(t[i], t[(i + 1) % 3]);
        for (std::size_t n = past_.size() - 1; n > 0; --n) past_[n] = past_[n - 1];
        past_[0] = t;
    }

private:
    std::uint32_t first_candidate(std::uint8_t kind) const
    {
        const std::uint32_t one = past_[0][0], two = past_[1][0];
        switch (kind) {
        case same_step_1:
            return one + (one - two);
        case same_step_2:
            return two + (two - past_[3][0]);
        case same_span_1:
            return one + 1;
        case same_span_2:
            return one - 1;
        case open_into_first:
            return two + 1;
        case open_out_of_first:
            return two - 1;
        case open_into:
            return out_of_[one];
        default:
            return into_[one];
        }
    }
    std::uint32_t later_candidate(std::uint8_t kind, const Triangle& x, std::uint32_t j) const
    {
        const Triangle &one = past_[0], &two = past_[1];
        switch (kind) {
        case same_step_1:
            return x[j - 1] + (one[j] - one[j - 1]);
        case same_step_2:
            return x[j - 1] + (two[j] - two[j - 1]);
        case same_span_1:
            return j == 1 ? x[0] + 1 : x[0] + (one[j] - one[0]);
        case same_span_2:
            return j == 1 ? x[0] - 1 : x[0] + (two[j] - two[0]);
        case open_into:
            return into_[x[j - 1]];
        case open_out_of:
            return out_of_[x[j - 1]];
        case open_into_first:
            return into_[x[0]];
        default:
            return out_of_[x[0]];
        }
    }
    void add_edge(std::uint32_t a, std::uint32_t b)
    {
        if (out_of_[b] == a || into_[a] == b) {
            if (out_of_[b] == a) out_of_[b] = none;
            if (into_[a] == b) into_[a] = none;
            return;
        }
        out_of_[a] = b;
        into_[b] = a;
    }

    std::uint32_t vertex_count_;
    std::vector<bool> seen_;
    std::vector<std::uint32_t> into_, out_of_; ///< [W] other end of the open edge met last, or none
    std::array<Triangle, 4> past_{};
    std::uint32_t last_new_ = 0xffffffff, next_unseen_ = 0;
};

/// Which kinds proved right lately.
struct Hits {
    std::array<std::array<std::uint8_t, 3>, 3> past{}; ///< [triangles back][corner]
    std::array<std::uint8_t, 3> now{};
};

template <class Coder>
class SequenceCoder {
public:
    SequenceCoder(Coder& coder, std::uint32_t vertex_count)
        : coder_(coder), history_(vertex_count), unseen_(vertex_count, true)
    {
    }

    /// @fails bad_input: an index that does not exist.
    Status code(std::span<Triangle> triangles)
    {
        for (Triangle& t : triangles) {
            for (std::uint32_t j = 0; j < 3; ++j) {
                t[j] = corner(t, j, t[j]);
                if (t[j] >= history_.vertex_count()) return bad_input("an index that does not exist", "sequence");
                if (!history_.seen(t[j])) unseen_.erase(t[j]);
                history_.met(t[j]);
            }
            if (cut()) return bad_input("the bytes end too early", "sequence");
            history_.add(t);
            hits_.past = {hits_.now, hits_.past[0], hits_.past[1]};
        }
        return Ok{};
    }

private:
    bool cut() const
    {
        if constexpr (Coder::writes)
            return false;
        else
            return coder_.overrun();
    }

    std::uint32_t corner(const Triangle& x, std::uint32_t j, std::uint32_t wanted)
    {
        std::array<std::uint32_t, kinds> value;
        for (std::uint8_t kind = 0; kind < kinds; ++kind) {
            value[kind] = history_.candidate(kind, x, j);
            const bool repeats = (j > 0 && value[kind] == x[0]) || (j > 1 && value[kind] == x[1]);
            if (repeats || value[kind] >= history_.vertex_count()) value[kind] = none;
        }
        TryOrder<kinds>& order = order_[j][hits_.past[0][j]];
        for (std::size_t place = 0; place < kinds; ++place) {
            const std::uint8_t kind = order[place];
            const std::uint32_t candidate = value[kind];
            if (candidate == none) continue;
            const auto alike = static_cast<std::uint32_t>(std::count(value.begin(), value.end(), candidate));
            std::replace(value.begin(), value.end(), candidate, none);
            const std::uint32_t near = std::min(static_cast<std::uint32_t>(place), 3u);
            const std::uint32_t features = std::min(alike, 3u) * 8 + near * 2 + (history_.seen(candidate) ? 1 : 0);
            if (!judge_.code(coder_, j * 32 + kind, contexts(j, features), wanted == candidate)) continue;
            hits_.now[j] = kind;
            order.right(place);
            return candidate;
        }
        hits_.now[j] = escape;
        return escaped(x, j, wanted);
    }

    Judge::Contexts contexts(std::uint32_t j, std::uint32_t features) const
    {
        const auto hit = [&](std::size_t back, std::uint32_t corner) { return hits_.past[back][corner] * 1u; };
        const std::uint32_t one = hit(0, j), two = hit(1, j);
        const std::uint32_t in_triangle = j == 0   ? hit(0, 2) * 32 + hit(0, 1)
                                          : j == 1 ? hits_.now[0] * 32u + hit(0, 2)
                                                   : hits_.now[1] * 32u + hits_.now[0];
        return {one,
                one * 32 + two,
                in_triangle,
                features,
                (in_triangle * 32 + one) * 32 + two,
                (in_triangle * 32 + two) * 1024 + features};
    }

    /// None of the candidates: a new vertex by its rank among the new ones, or an old one by its number.
    std::uint32_t escaped(const Triangle& x, std::uint32_t j, std::uint32_t wanted)
    {
        const std::uint32_t near = j > 0 ? x[j - 1] : history_.back(1)[0];
        const bool fresh = coder_.bit(fresh_[j], Coder::writes && !history_.seen(wanted));
        if (!fresh) {
            const std::uint64_t folded = jump_[j].code(coder_, coding::zigzag(std::int64_t{wanted} - near));
            return static_cast<std::uint32_t>(near + coding::unzigzag(folded));
        }
        const std::uint32_t from = j > 0 ? x[j - 1] : history_.last_new() + 1;
        const std::int64_t base = unseen_.rank(std::min(from, history_.vertex_count()));
        const std::int64_t rank = Coder::writes ? unseen_.rank(wanted) : 0;
        const std::int64_t found = base + coding::unzigzag(new_[j].code(coder_, coding::zigzag(rank - base)));
        return found >= 0 && found < unseen_.size() ? unseen_.at(static_cast<std::uint32_t>(found)) : none;
    }

    Coder& coder_;
    History history_;
    RankSet unseen_;
    Hits hits_;
    Judge judge_;
    std::array<std::array<TryOrder<kinds>, kinds + 1>, 3> order_; ///< [corner][last hit there]
    coding::Bit fresh_[3];
    coding::NumberModel jump_[3], new_[3];
};

} // namespace

void write_sequence(coding::RangeEncoder& coder, std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    std::vector<Triangle> same(triangles.begin(), triangles.end());
    (void)SequenceCoder(coder, vertex_count).code(same);
}

Result<std::vector<Triangle>> read_sequence(coding::RangeDecoder& coder, std::uint32_t vertex_count,
                                            std::uint32_t triangle_count)
{
    if (vertex_count == 0 && triangle_count > 0) return bad_input("triangles without vertices", "vertex_count");
    std::vector<Triangle> triangles(triangle_count);
    MESHREEL_CHECK(SequenceCoder(coder, vertex_count).code(triangles));
    return triangles;
}

} // namespace meshreel::connectivity
