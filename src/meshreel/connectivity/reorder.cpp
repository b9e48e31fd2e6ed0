/// Steps of a walk over triangles, and numbers from their neighbours' numbers.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/reorder.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "meshreel/coding/model.h"
#include "meshreel/coding/varint.h"
#include "meshreel/connectivity/adjacency.h"
#include "meshreel/connectivity/judge.h"
#include "meshreel/connectivity/rank_set.h"

namespace meshreel::connectivity {

namespace {

/// What a new vertex's number is compared with when it cannot be guessed.
enum class Reference : std::uint8_t { lowest, last_new, neighbour };
constexpr std::uint32_t references = 3;

/// What the encoder found best.
struct Choice {
    Reference reference = Reference::lowest;
    bool from_last = false; ///< far triangles are counted from the last one, not from the newest of the frontier

    template <class Coder>
    void code(Coder& coder)
    {
        const std::uint32_t both = static_cast<std::uint32_t>(reference) << 1 | (from_last ? 1 : 0);
        const std::uint32_t found = coder.raw(both, 3);
        reference = static_cast<Reference>(found >> 1);
        from_last = (found & 1) != 0;
    }
};

/// The mesh, and what both sides know of the order so far.
class Walked {
public:
    Walked(std::uint32_t vertex_count, std::span<const Triangle> triangles)
        : mesh_(adjacency(vertex_count, triangles)), visited_(triangles.size()), number_(vertex_count, none),
          vertex_(vertex_count, none), corner_(vertex_count, none), left_(vertex_count, 0),
          frontier_(triangle_count(), false), stamp_(triangles.size(), none), unvisited_(triangle_count(), true),
          unused_(vertex_count, true)
    {
        for (std::uint32_t h = 3 * triangle_count(); h-- > 0;) {
            corner_[mesh_.from(h)] = h;
            ++left_[mesh_.from(h)];
        }
    }

    const Adjacency& mesh() const { return mesh_; }
    std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }
    bool visited(std::uint32_t k) const { return visited_[k] != 0; }
    std::uint32_t number_at(std::uint32_t h) const { return number_[mesh_.from(h)]; }
    const RankSet& unvisited() const { return unvisited_; }
    const RankSet& frontier() const { return frontier_; }
    const RankSet& unused() const { return unused_; }
    bool is_unused(std::uint32_t number) const { return number < vertex_.size() && vertex_[number] == none; }
    std::uint32_t stamp(std::uint32_t k) const { return stamp_[k]; }
    std::uint32_t stamped(std::uint32_t stamp) const { return stamped_[stamp]; }
    /// How many have been given.
    std::uint32_t stamps() const { return static_cast<std::uint32_t>(stamped_.size()); }

    std::uint32_t across(std::uint32_t h) const { return mesh_.twin[h] == none ? none : mesh_.twin[h] / 3; }
    /// The triangle beyond the next (or, back, the previous) edge of the one beyond h.
    std::uint32_t beyond(std::uint32_t h, bool back) const
    {
        const std::uint32_t twin = mesh_.twin[h];
        return twin == none ? none : across(back ? previous_half(twin) : next_half(twin));
    }
    /// The first unvisited triangle met when turning about the origin of h, or none within a few steps.
    std::uint32_t around(std::uint32_t h, bool clockwise) const
    {
        if (left_[mesh_.from(h)] == 0) return none;
        for (int step = 0; step < 12 && h != none; ++step) {
            if (!visited(h / 3)) return h / 3;
            h = clockwise ? mesh_.twin[h] : mesh_.twin[previous_half(h)];
            if (clockwise && h != none) h = next_half(h);
        }
        return none;
    }
    /// An unvisited triangle at the vertex of that number.
    std::uint32_t at_number(std::uint32_t number) const
    {
        if (number >= vertex_.size() || vertex_[number] == none) return none;
        const std::uint32_t corner = corner_[vertex_[number]];
        const std::uint32_t found = around(corner, false);
        return found != none ? found : around(corner, true);
    }
    /// number(a) + number(b) - number(c) over the edge opposite to corner h, or none.
    std::uint32_t parallelogram(std::uint32_t h) const
    {
        const std::uint32_t edge = next_half(h), twin = mesh_.twin[edge];
        if (twin == none) return none;
        const std::uint32_t a = number_at(edge), b = number_at(next_half(edge)), c = number_at(previous_half(twin));
        return a == none || b == none || c == none ? none : a + b - c;
    }

    void visit(std::uint32_t k)
    {
        visited_[k] = 1;
        unvisited_.erase(k);
        if (stamp_[k] != none) frontier_.erase(stamp_[k]);
        for (std::uint32_t h = 3 * k; h < 3 * k + 3; ++h) {
            --left_[mesh_.from(h)];
            const std::uint32_t other = across(h);
            if (other == none || visited(other) || stamp_[other] != none) continue;
            stamp_[other] = static_cast<std::uint32_t>(stamped_.size());
            stamped_.push_back(other);
            frontier_.insert(stamp_[other]);
        }
    }
    void give(std::uint32_t h, std::uint32_t number)
    {
        number_[mesh_.from(h)] = number;
        vertex_[number] = mesh_.from(h);
        unused_.erase(number);
    }

private:
    Adjacency mesh_;
    std::vector<std::uint8_t> visited_;
    std::vector<std::uint32_t> number_, vertex_; ///< [W] number of each vertex and back, none where not yet known
    std::vector<std::uint32_t> corner_;          ///< [W] a corner of each vertex
    std::vector<std::uint32_t> left_;            ///< [W] corners of unvisited triangles at each vertex
    RankSet frontier_;                           ///< stamps of unvisited triangles beside visited ones
    std::vector<std::uint32_t> stamp_, stamped_; ///< when a triangle came to the frontier, and back
    RankSet unvisited_, unused_;
};

/// Clears all that are the one. Returns how many they were. Without a branch: compilers make vectors of it.
template <std::size_t size>
std::uint32_t take_all(std::array<std::uint32_t, size>& values, std::uint32_t one)
{
    std::uint32_t alike = 0;
    for (std::uint32_t& value : values) {
        alike += value == one ? 1 : 0;
        value = value == one ? none : value;
    }
    return alike;
}

template <class Coder>
class OrderCoder {
public:
    OrderCoder(Coder& coder, Walked& walked, const Choice& choice) : coder_(coder), walked_(walked), choice_(choice) {}

    /// @param wanted  half-edge (of the turned triangles) at the first corner of the next triangle; its numbers.
    /// @return that half-edge, or none where the bytes are wrong; every corner has its number.
    std::uint32_t next(std::uint32_t wanted, const Triangle& numbers)
    {
        const std::uint32_t k = triangle(wanted / 3);
        if (k == none) return none;
        const std::uint32_t first = 3 * k + rotation(k, wanted % 3);
        walked_.visit(k);
        const bool flipped = walked_.mesh().flipped[k] != 0; // then the second corner is the turned triangle's third
        const std::array<std::uint32_t, 3> corners = {first, flipped ? previous_half(first) : next_half(first),
                                                      flipped ? next_half(first) : previous_half(first)};
        for (std::uint32_t j = 0; j < 3; ++j) {
            if (walked_.number_at(corners[j]) == none && !name(corners, j, numbers[j])) return none;
            at_corner_[j] = walked_.number_at(corners[j]);
        }
        past_ = {first, past_[0]};
        firsts_ = {at_corner_[0], firsts_[0], firsts_[1], firsts_[2]};
        return first;
    }

private:
    // ---- which triangle ------------------------------------------------------------------------------------------
    static constexpr std::uint8_t moves = 32;

    using Moves = std::array<std::uint32_t, moves>;

    /// Where each move leads: an unvisited triangle, or none.
    Moves candidates() const
    {
        Moves value;
        value.fill(none);
        if (walked_.unvisited().size() > 0) value[24] = walked_.unvisited().first();
        const std::uint32_t h = past_[0];
        if (h == none) return value;
        add_neighbours(h, value);
        add_numbered(value);
        add_frontier(h / 3, value);
        value[25] = h / 3 + 1 < walked_.triangle_count() ? h / 3 + 1 : none;
        for (std::uint32_t& k : value)
            if (k != none && walked_.visited(k)) k = none;
        return value;
    }
    void add_neighbours(std::uint32_t h, Moves& value) const
    {
        const std::array<std::uint32_t, 3> edge = {h, next_half(h), previous_half(h)};
        for (std::uint32_t i = 0; i < 3; ++i) {
            value[i] = walked_.across(edge[i]);
            value[3 + 2 * i] = walked_.beyond(edge[i], false);
            value[4 + 2 * i] = walked_.beyond(edge[i], true);
            if (past_[1] != none) value[9 + i] = walked_.across(turned(past_[1], i));
            value[12 + 2 * i] = walked_.around(edge[i], true);
            value[13 + 2 * i] = walked_.around(edge[i], false);
        }
    }
    void add_numbered(Moves& value) const
    {
        value[18] = walked_.at_number(at_corner_[0] + 1);
        value[19] = walked_.at_number(at_corner_[0] - 1);
        value[20] = walked_.at_number(at_corner_[1] + 1);
        value[21] = walked_.at_number(last_new_);
        value[30] = walked_.at_number(firsts_[0] + (firsts_[0] - firsts_[1]));
        value[31] = walked_.at_number(firsts_[1] + (firsts_[1] - firsts_[3]));
    }
    /// k: the last triangle.
    void add_frontier(std::uint32_t k, Moves& value) const
    {
        const RankSet& frontier = walked_.frontier();
        if (frontier.size() == 0) return;
        value[22] = walked_.stamped(frontier.before(walked_.stamps()));
        value[23] = walked_.stamped(frontier.first());
        std::tie(value[26], value[27]) = beside_in_frontier(k);
        std::tie(value[28], value[29]) = beside_in_frontier(last_far_);
    }
    static std::uint32_t turned(std::uint32_t h, std::uint32_t by) { return h - h % 3 + (h % 3 + by) % 3; }

    /// The triangles that came to the frontier next after and next before triangle k did, which is not in it any more.
    std::pair<std::uint32_t, std::uint32_t> beside_in_frontier(std::uint32_t k) const
    {
        if (k == none || walked_.stamp(k) == none) return {none, none};
        const RankSet& frontier = walked_.frontier();
        const std::uint32_t after = frontier.after(walked_.stamp(k)), before = frontier.before(walked_.stamp(k));
        return {after == RankSet::nobody ? none : walked_.stamped(after),
                before == RankSet::nobody ? none : walked_.stamped(before)};
    }

    std::uint32_t triangle(std::uint32_t wanted)
    {
        Moves value = candidates();
        TryOrder<moves>& order = move_order_[hits_[0]];
        for (std::size_t place = 0; place < moves; ++place) {
            const std::uint8_t move = order[place];
            const std::uint32_t k = value[move];
            if (k == none) continue;
            const std::uint32_t alike = take_all(value, k);
            if (!moves_.code(coder_, move, contexts(k, alike, place), wanted == k)) continue;
            order.right(place);
            hits_ = {move, hits_[0], hits_[1], hits_[2]};
            return k;
        }
        hits_ = {moves, hits_[0], hits_[1], hits_[2]};
        return last_far_ = far_triangle(wanted);
    }

    Judge::Contexts contexts(std::uint32_t k, std::uint32_t alike, std::size_t place) const
    {
        std::uint32_t numbered = 0, beside = 0;
        for (std::uint32_t h = 3 * k; h < 3 * k + 3; ++h) {
            const std::uint32_t other = walked_.across(h);
            numbered += walked_.number_at(h) != none ? 1 : 0;
            beside += other == none || walked_.visited(other) ? 1 : 0;
        }
        const std::uint32_t near = std::min(static_cast<std::uint32_t>(place), 3u);
        const std::uint32_t features = ((std::min(alike, 3u) * 4 + numbered) * 4 + beside) * 4 + near;
        const std::uint32_t two = hits_[0] * 64u + hits_[1], three = two * 64u + hits_[2];
        return {hits_[0] * 1u, two, three, three * 64u + hits_[3], features, two * 256u + features};
    }

    /// No candidate: by its place in the frontier, newest first, or among all that are left.
    std::uint32_t far_triangle(std::uint32_t wanted)
    {
        const RankSet &frontier = walked_.frontier(), &unvisited = walked_.unvisited();
        const bool near =
            frontier.size() > 0 && coder_.bit(in_frontier_, Coder::writes && walked_.stamp(wanted) != none);
        const RankSet& among = near ? frontier : unvisited;
        const std::int64_t rank = !Coder::writes ? 0
                                  : near         ? frontier.rank(walked_.stamp(wanted))
                                                 : unvisited.rank(wanted);
        std::int64_t from = near ? frontier.size() - 1 : 0; // the newest, the first
        if (choice_.from_last && last_far_ != none) {
            if (!near)
                from = unvisited.rank(last_far_);
            else if (walked_.stamp(last_far_) != none)
                from = frontier.rank(walked_.stamp(last_far_));
        }
        const std::int64_t found =
            from + coding::unzigzag(far_[near ? 1 : 0].code(coder_, coding::zigzag(rank - from)));
        if (found < 0 || found >= among.size()) return none;
        const std::uint32_t element = among.at(static_cast<std::uint32_t>(found));
        return near ? walked_.stamped(element) : element;
    }

    // ---- which corner is first -----------------------------------------------------------------------------------
    std::uint32_t rotation(std::uint32_t k, std::uint32_t wanted)
    {
        std::uint32_t base = 0, best = none;
        for (std::uint32_t i = 0; i < 3; ++i) { // the corner known by the most recent, smallest sign
            const std::uint32_t number = walked_.number_at(3 * k + i);
            const std::uint32_t sign = number == none            ? none - 1
                                       : number == at_corner_[0] ? 0
                                       : number == at_corner_[1] ? 1
                                       : number == at_corner_[2] ? 2
                                                                 : number + 3;
            if (sign >= best) continue;
            best = sign;
            base = i;
        }
        std::uint32_t known = 0, order = 0;
        std::array<std::uint32_t, 3> numbers;
        for (std::uint32_t i = 0; i < 3; ++i) {
            numbers[i] = walked_.number_at(3 * k + (base + i) % 3);
            known = known * 2 + (numbers[i] != none ? 1 : 0);
        }
        order = (numbers[0] < numbers[1] ? 1u : 0u) + (numbers[1] < numbers[2] ? 2u : 0u) +
                (numbers[2] < numbers[0] ? 4u : 0u);
        const std::uint32_t sign = std::min(best, 3u), shape = (known * 8 + order) * 4 + sign;
        const Judge::Contexts seen = {
            hits_[0] * 1u,          hits_[0] * 64u + hits_[1],       shape,
            shape * 64u + hits_[0], (turns_ & 63u) * 64u + hits_[0], (turns_ & 15u) * 256u + shape};
        const std::uint32_t turn = (wanted + 3 - base) % 3;
        const bool stays = rotations_.code(coder_, 0, seen, turn == 0);
        const bool one = !stays && rotations_.code(coder_, 1, seen, turn == 1);
        const std::uint32_t found = stays ? 0 : one ? 1 : 2;
        turns_ = turns_ * 4 + found;
        return (base + found) % 3;
    }

    // ---- which number a new vertex has ---------------------------------------------------------------------------
    static constexpr std::uint8_t guesses = 9;

    std::uint32_t guess(std::uint8_t kind, const std::array<std::uint32_t, 3>& corners, std::uint32_t j) const
    {
        const std::uint32_t before = walked_.number_at(corners[(j + 2) % 3]),
                            after = walked_.number_at(corners[(j + 1) % 3]);
        switch (kind) {
        case 0:
            return walked_.unused().first();
        case 1:
            return last_new_ + 1;
        case 2:
            return last_new_ - 1;
        case 3:
            return walked_.parallelogram(corners[j]);
        case 4:
            return before == none ? none : before + 1;
        case 5:
            return before == none ? none : before - 1;
        case 6:
            return after == none ? none : after + 1;
        case 7:
            return after == none ? none : after - 1;
        default:
            return last_new_ + (last_new_ - new_before_);
        }
    }

    bool name(const std::array<std::uint32_t, 3>& corners, std::uint32_t j, std::uint32_t wanted)
    {
        const RankSet& unused = walked_.unused();
        if (unused.size() == 0) return false;
        std::uint32_t found = none;
        std::array<std::uint32_t, guesses> value;
        for (std::uint8_t kind = 0; kind < guesses; ++kind) {
            value[kind] = guess(kind, corners, j);
            if (value[kind] != none && !walked_.is_unused(value[kind])) value[kind] = none;
        }
        std::uint8_t hit = guesses;
        for (std::size_t place = 0; place < guesses && found == none; ++place) {
            const std::uint8_t kind = guess_order_[j][place];
            const std::uint32_t number = value[kind];
            if (number == none) continue;
            const std::uint32_t alike = take_all(value, number);
            const std::uint32_t now = hits_[0] * 3u + j,
                                features = std::min(alike, 3u) * 4 +
                                           std::min<std::uint32_t>(static_cast<std::uint32_t>(place), 3u);
            const Judge::Contexts seen = {now,
                                          named_[0] * 4u + j,
                                          (named_[0] * 16u + named_[1]) * 4 + j,
                                          features * 4 + j,
                                          ((named_[0] * 16u + named_[1]) * 16 + named_[2]) * 128 + now,
                                          (named_[0] * 128u + now) * 16 + features};
            if (!names_.code(coder_, kind, seen, wanted == number)) continue;
            guess_order_[j].right(place);
            hit = kind;
            found = number;
        }
        if (found == none) found = far_number(corners, j, wanted);
        if (found == none) return false;
        named_ = {hit, named_[0], named_[1]};
        new_before_ = last_new_;
        last_new_ = found;
        walked_.give(corners[j], found);
        return true;
    }

    std::uint32_t far_number(const std::array<std::uint32_t, 3>& corners, std::uint32_t j, std::uint32_t wanted)
    {
        const RankSet& unused = walked_.unused();
        std::uint32_t from = choice_.reference == Reference::lowest ? 0 : last_new_;
        for (std::uint32_t i = 1; i < 3 && choice_.reference == Reference::neighbour; ++i) {
            const std::uint32_t number = walked_.number_at(corners[(j + 3 - i) % 3]);
            if (number == none) continue;
            from = number;
            break;
        }
        const std::int64_t base = from == none ? 0 : unused.rank(from);
        const std::int64_t rank = Coder::writes ? unused.rank(wanted) : 0;
        const std::int64_t found = base + coding::unzigzag(numbers_[j].code(coder_, coding::zigzag(rank - base)));
        return found >= 0 && found < unused.size() ? unused.at(static_cast<std::uint32_t>(found)) : none;
    }

    Coder& coder_;
    Walked& walked_;
    Choice choice_;
    std::array<std::uint32_t, 2> past_ = {none, none};               ///< first corners of the last two triangles
    std::array<std::uint32_t, 3> at_corner_ = {none, none, none};    ///< numbers of the last triangle
    std::array<std::uint32_t, 4> firsts_ = {none, none, none, none}; ///< first corners' numbers, newest first
    std::uint32_t last_far_ = none;                                  ///< the last triangle that no move reached
    std::array<std::uint8_t, 4> hits_ = {moves, moves, moves, moves};
    std::array<std::uint8_t, 3> named_ = {guesses, guesses, guesses};
    std::uint32_t turns_ = 0, last_new_ = none, new_before_ = none;
    std::array<TryOrder<moves>, moves + 1> move_order_;
    std::array<TryOrder<guesses>, 3> guess_order_;
    Judge moves_, rotations_, names_;
    coding::Bit in_frontier_;
    coding::NumberModel far_[2], numbers_[3];
};

/// The order that was lost: for each triangle of the input its half-edge in the turned shell.
std::vector<std::uint32_t> lost_order(const Adjacency& mesh, const Shelled& shelled)
{
    std::vector<std::uint32_t> first(shelled.corner_of.size() / 3);
    for (std::uint32_t c = 0; c < shelled.corner_of.size(); ++c)
        if (shelled.corner_of[c] % 3 == 0) first[shelled.corner_of[c] / 3] = mesh.input_corner(c);
    return first;
}

void write_with(coding::RangeEncoder& coder, Walked walked, const Shelled& shelled, Choice choice)
{
    const std::vector<std::uint32_t> first = lost_order(walked.mesh(), shelled);
    choice.code(coder);
    OrderCoder order(coder, walked, choice);
    for (const std::uint32_t h : first) {
        Triangle numbers;
        const bool flipped = walked.mesh().flipped[h / 3] != 0;
        numbers[0] = shelled.vertex_of[walked.mesh().from(h)];
        numbers[1] = shelled.vertex_of[walked.mesh().from(flipped ? previous_half(h) : next_half(h))];
        numbers[2] = shelled.vertex_of[walked.mesh().from(flipped ? next_half(h) : previous_half(h))];
        order.next(h, numbers);
    }
}

} // namespace

void write_order(coding::RangeEncoder& coder, std::uint32_t vertex_count, const Shelled& shelled)
{
    const Walked walked(vertex_count, *triangles_of(shelled.shell));
    std::optional<coding::RangeEncoder> best;
    Choice chosen;
    const auto attempt = [&](const Choice& choice) {
        coding::RangeEncoder trial = coder;
        write_with(trial, walked, shelled, choice);
        if (best && trial.size() >= best->size()) return;
        best = std::move(trial);
        chosen = choice;
    };
    for (std::uint32_t reference = 0; reference < references; ++reference)
        attempt({static_cast<Reference>(reference), false});
    attempt({chosen.reference, true});
    coder = std::move(*best);
}

Result<std::vector<Triangle>> read_order(coding::RangeDecoder& coder, std::uint32_t vertex_count,
                                         std::span<const Triangle> triangles)
{
    Choice choice;
    choice.code(coder);
    if (static_cast<std::uint32_t>(choice.reference) >= references) return bad_input("no such reference", "order");
    Walked walked(vertex_count, triangles);
    OrderCoder order(coder, walked, choice);
    std::vector<Triangle> ordered(triangles.size());
    for (Triangle& t : ordered) {
        const std::uint32_t h = order.next(0, {});
        if (h == none) return bad_input("no such triangle or vertex", "order");
        if (coder.overrun()) return bad_input("the bytes end too early", "order");
        const bool flipped = walked.mesh().flipped[h / 3] != 0;
        t = {walked.number_at(h), walked.number_at(flipped ? previous_half(h) : next_half(h)),
             walked.number_at(flipped ? next_half(h) : previous_half(h))};
    }
    return ordered;
}

} // namespace meshreel::connectivity
