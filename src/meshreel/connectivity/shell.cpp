/// Names for vertices, and the payload's models.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/shell.h"

#include <algorithm>

#include "meshreel/coding/model.h"
#include "meshreel/coding/varint.h"
#include "meshreel/connectivity/adjacency.h"
#include "meshreel/connectivity/closed_mesh.h"

namespace meshreel::connectivity {

namespace {

using coding::Bit;
using coding::NumberModel;

constexpr std::uint32_t closed_ratio = 4; ///< closing the holes of T triangles makes at most 4T of them

/// Predicts the next symbol from the two before it and from how many triangles the gate's right vertex has seen as such.
class SymbolModel {
public:
    template <class Coder>
    Clers code(Coder& coder, Clers wanted)
    {
        Bit* models = &bits_[((one_before_ * 5 + two_before_) * (longest_run + 1) + run_) * 4];
        Clers symbol = Clers::S;
        if (coder.bit(models[0], wanted == Clers::C))
            symbol = Clers::C;
        else if (coder.bit(models[1], wanted == Clers::R))
            symbol = Clers::R;
        else if (coder.bit(models[2], wanted == Clers::L))
            symbol = Clers::L;
        else if (coder.bit(models[3], wanted == Clers::E))
            symbol = Clers::E;
        const bool same_pivot = symbol == Clers::C || symbol == Clers::L;
        run_ = same_pivot ? std::min(run_ + 1, longest_run) : 0;
        two_before_ = one_before_;
        one_before_ = static_cast<std::uint32_t>(symbol);
        return symbol;
    }

private:
    static constexpr std::uint32_t longest_run = 7;

    std::array<Bit, 5 * 5 * (longest_run + 1) * 4> bits_;
    std::uint32_t one_before_ = 0, two_before_ = 0, run_ = 0;
};

/// Codes every field of a shell, in one order for both directions. A decoder stops early where bytes are cut.
template <class Coder>
class ShellCoder {
public:
    ShellCoder(Coder& coder, Shell& shell) : coder_(coder), shell_(shell) {}

    /// @param most_closed  upper limit of the closed mesh's triangles.
    Status run(std::uint64_t most_closed)
    {
        std::uint32_t& closed = shell_.string.triangle_count;
        const std::uint64_t holes = size_.code(coder_, closed - shell_.triangle_count);
        if (holes > std::uint64_t{closed_ratio - 1} * shell_.triangle_count)
            return bad_input("more triangles than closing holes can make", "closed_triangle_count");
        MESHREEL_CHECK(within(shell_.triangle_count + holes, most_closed, "closed_triangle_count"));
        closed = shell_.triangle_count + static_cast<std::uint32_t>(holes);
        MESHREEL_CHECK(merges());
        MESHREEL_CHECK(symbols());
        MESHREEL_CHECK(copies());
        return flips();
    }

private:
    std::uint32_t number(NumberModel& model, std::uint32_t wanted)
    {
        return static_cast<std::uint32_t>(model.code(coder_, wanted));
    }
    bool cut() const
    {
        if constexpr (Coder::writes)
            return false;
        else
            return coder_.overrun();
    }
    Status cut_or_ok(const char* field) const
    {
        if (cut()) return bad_input("the bytes end too early", field);
        return Ok{};
    }

    Status merges()
    {
        std::vector<Merge>& merges = shell_.string.merges;
        const std::uint32_t count = number(merge_.count, static_cast<std::uint32_t>(merges.size()));
        std::uint32_t place = 0;
        for (std::uint32_t i = 0; i < count && !cut(); ++i) {
            if constexpr (!Coder::writes) merges.emplace_back();
            Merge& merge = merges[i];
            place = merge.symbol = place + number(merge_.gap, merge.symbol - place);
            merge.depth = number(merge_.depth, merge.depth);
            merge.position = number(merge_.position, merge.position);
            merge.length = number(merge_.length, merge.length);
            if (++place > shell_.string.triangle_count) return bad_input("beyond the last symbol", "merges");
        }
        return cut_or_ok("merges");
    }

    Status symbols()
    {
        ClersString& string = shell_.string;
        SymbolModel model;
        std::size_t i = 0, merge = 0;
        std::uint64_t open = 0;
        for (std::uint32_t t = 0; t < string.triangle_count && !cut(); ++t) {
            if (open == 0) {
                open = 1;
                continue;
            }
            const Clers symbol = model.code(coder_, Coder::writes ? string.symbols[i] : Clers::C);
            if constexpr (!Coder::writes) string.symbols.push_back(symbol);
            const bool merges = merge < string.merges.size() && string.merges[merge].symbol == i;
            if (merges) ++merge;
            if (merges || symbol == Clers::E)
                --open;
            else if (symbol == Clers::S)
                ++open;
            ++i;
        }
        return cut_or_ok("clers");
    }

    std::size_t copy_count() const
    {
        const std::vector<Clers>& symbols = shell_.string.symbols;
        const auto fresh = static_cast<std::size_t>(std::count(symbols.begin(), symbols.end(), Clers::C));
        return fresh + 3 * (shell_.string.triangle_count - symbols.size());
    }

    Status copies()
    {
        std::vector<std::uint32_t>& copies = shell_.copies;
        if constexpr (!Coder::writes) copies.assign(copy_count(), Shell::fresh);
        const auto has = [&](auto kind) { return std::find_if(copies.begin(), copies.end(), kind) != copies.end(); };
        const bool dummies = coder_.bit(copy_.any[0], has([](std::uint32_t c) { return c == Shell::dummy; }));
        const bool glued = coder_.bit(copy_.any[1], has([](std::uint32_t c) { return c < Shell::dummy; }));
        if (!dummies && !glued) return cut_or_ok("copies");
        std::uint32_t vertices = 0, last = 0;
        std::size_t before = 0;
        for (std::uint32_t& copy : copies) {
            const bool is_dummy = dummies && coder_.bit(copy_.dummy[before], copy == Shell::dummy);
            const bool is_glued = !is_dummy && glued && coder_.bit(copy_.glued[before], copy < Shell::dummy);
            if (is_glued) {
                const std::uint64_t jump = coding::zigzag(std::int64_t{copy} - last);
                const std::int64_t target = last + coding::unzigzag(copy_.jump.code(coder_, jump));
                if (target < 0 || target >= vertices)
                    return bad_input("glued to a vertex that is not yet met", "copies");
                copy = last = static_cast<std::uint32_t>(target);
            } else {
                copy = is_dummy ? Shell::dummy : Shell::fresh;
                vertices += is_dummy ? 0 : 1;
            }
            before = is_dummy ? 1 : is_glued ? 2 : 0;
            if (cut()) break;
        }
        return cut_or_ok("copies");
    }

    Status flips()
    {
        std::vector<std::uint8_t>& flipped = shell_.flipped;
        if constexpr (!Coder::writes) flipped.assign(shell_.triangle_count, 0);
        if (!coder_.bit(flip_.any, std::find(flipped.begin(), flipped.end(), 1) != flipped.end()))
            return cut_or_ok("flips");
        std::size_t history = 0;
        for (std::uint8_t& flip : flipped) {
            flip = coder_.bit(flip_.bits[history], flip != 0) ? 1 : 0;
            history = (history << 1 | flip) & 15u;
            if (cut()) break;
        }
        return cut_or_ok("flips");
    }

    Coder& coder_;
    Shell& shell_;
    NumberModel size_;
    struct {
        NumberModel count, gap, depth, position, length;
    } merge_;
    struct {
        Bit any[2], dummy[3], glued[3]; // by what the copy before was
        NumberModel jump;
    } copy_;
    struct {
        Bit any, bits[16]; // by the four flips before
    } flip_;
};

} // namespace

std::optional<Shelled> shell_of(std::uint32_t vertex_count, std::span<const Triangle> triangles)
{
    const Adjacency mesh = adjacency(vertex_count, triangles);
    const ClosedMesh closed = close(mesh);
    std::optional<Conquest> conquest = conquer(closed);
    if (!conquest) return std::nullopt;
    Shelled result;
    result.shell.triangle_count = closed.real_triangles;
    result.shell.string = std::move(conquest->string);
    std::vector<std::uint32_t> number(vertex_count, none);
    for (const std::uint32_t copy : conquest->copies) {
        const std::uint32_t vertex = closed.vertex_of[copy];
        const bool again = vertex != none && number[vertex] != none;
        result.shell.copies.push_back(vertex == none ? Shell::dummy : again ? number[vertex] : Shell::fresh);
        if (vertex == none || again) continue;
        number[vertex] = static_cast<std::uint32_t>(result.vertex_of.size());
        result.vertex_of.push_back(vertex);
    }
    for (const std::uint32_t h : conquest->half_of) {
        if (h / 3 >= closed.real_triangles) continue;
        const std::uint8_t flipped = mesh.flipped[h / 3];
        result.shell.flipped.push_back(flipped);
        const std::uint32_t second = next_half(h), third = previous_half(h);
        for (const std::uint32_t corner : {h, flipped != 0 ? third : second, flipped != 0 ? second : third})
            result.corner_of.push_back(mesh.input_corner(corner));
    }
    return result;
}

Result<std::vector<Triangle>> triangles_of(const Shell& shell)
{
    MESHREEL_TRY(std::vector<Triangle> triangles, rebuild(shell.string));
    std::vector<std::uint32_t> number;
    std::uint32_t vertices = 0;
    number.reserve(shell.copies.size());
    for (const std::uint32_t copy : shell.copies) number.push_back(copy == Shell::fresh ? vertices++ : copy);
    std::size_t real = 0;
    for (const Triangle& closed : triangles) {
        const Triangle t = {number[closed[0]], number[closed[1]], number[closed[2]]};
        if (t[0] == Shell::dummy || t[1] == Shell::dummy || t[2] == Shell::dummy) continue;
        if (real == shell.triangle_count) return bad_input("more triangles than announced", "clers");
        const bool flipped = shell.flipped[real] != 0;
        triangles[real++] = flipped ? Triangle{t[0], t[2], t[1]} : t;
    }
    if (real != shell.triangle_count) return bad_input("fewer triangles than announced", "clers");
    triangles.resize(real);
    return triangles;
}

void write(coding::RangeEncoder& coder, const Shell& shell)
{
    Shell same = shell;
    (void)ShellCoder(coder, same).run(same.string.triangle_count);
}

Result<Shell> read(coding::RangeDecoder& coder, std::uint32_t triangle_count, std::uint64_t most_closed)
{
    Shell shell;
    shell.triangle_count = triangle_count;
    MESHREEL_CHECK(ShellCoder(coder, shell).run(most_closed));
    return shell;
}

} // namespace meshreel::connectivity
