/// Conquest writes the string; measuring it backwards tells the decoder how long each border is.
// SPDX-License-Identifier: MIT
#include "meshreel/connectivity/edgebreaker.h"

#include <algorithm>
#include <array>

#include "meshreel/base/text.h"
#include "meshreel/connectivity/border.h"

namespace meshreel::connectivity {

namespace {

class Conqueror {
public:
    explicit Conqueror(const ClosedMesh& mesh)
        : mesh_(mesh), border_(mesh.triangle_count()), budget_(mesh.triangle_count()),
          entered_(mesh.triangle_count(), none), met_(mesh.vertex_of.size()), waiting_(mesh.twin.size())
    {
        result_.string.triangle_count = mesh.triangle_count();
    }

    std::optional<Conquest> run()
    {
        for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t)
            if (entered_[t] == none && !component(t)) return std::nullopt;
        return std::move(result_);
    }

private:
    bool component(std::uint32_t first)
    {
        for (std::uint32_t i = 0; i < 3; ++i) meet(mesh_.copy_at[3 * first + i]);
        gate_ = border_.begin(enter(3 * first));
        for (;;) {
            const std::uint32_t g = mesh_.twin[half_of_edge(gate_)];
            const Clers symbol = symbol_at(g);
            const std::uint32_t at = symbol == Clers::S ? edge_at_tip(g) : none;
            const std::uint32_t k = enter(g);
            result_.string.symbols.push_back(symbol);
            if (symbol == Clers::E) {
                if (stack_.empty()) return true;
                gate_ = stack_.back();
                stack_.pop_back();
                waiting_[gate_] = false;
            } else if (!advance(symbol, k, at)) {
                return false;
            }
        }
    }

    /// Half-edge of the input behind a border edge.
    std::uint32_t half_of_edge(std::uint32_t edge) const
    {
        const std::uint32_t h = result_.half_of[edge / 3];
        return h - h % 3 + (h % 3 + edge % 3) % 3;
    }
    /// The border edge in front of which half-edge h lies, its twin being conquered.
    std::uint32_t edge_before(std::uint32_t h) const
    {
        const std::uint32_t inner = mesh_.twin[h], k = entered_[inner / 3];
        return 3 * k + (inner % 3 + 3 - result_.half_of[k] % 3) % 3;
    }
    bool conquered(std::uint32_t h) const { return entered_[h / 3] != none; }

    std::uint32_t enter(std::uint32_t half)
    {
        const auto k = static_cast<std::uint32_t>(result_.half_of.size());
        entered_[half / 3] = k;
        result_.half_of.push_back(half);
        return k;
    }
    void meet(std::uint32_t copy)
    {
        if (met_[copy]) return;
        met_[copy] = true;
        result_.copies.push_back(copy);
    }

    Clers symbol_at(std::uint32_t g)
    {
        const std::uint32_t tip = mesh_.copy_at[previous_half(g)];
        const bool right = conquered(mesh_.twin[next_half(g)]), left = conquered(mesh_.twin[previous_half(g)]);
        if (right || left) return right && left ? Clers::E : right ? Clers::R : Clers::L;
        if (met_[tip]) return Clers::S;
        meet(tip);
        return Clers::C;
    }

    /// The border edge whose left end is the tip of the triangle on g: turns about the tip both ways at once.
    std::uint32_t edge_at_tip(std::uint32_t g)
    {
        std::uint32_t out = previous_half(g), in = next_half(g);
        for (;;) {
            if (conquered(mesh_.twin[out])) return edge_before(out);
            if (conquered(mesh_.twin[in])) return border_.next(edge_before(in));
            out = next_half(mesh_.twin[out]);
            in = previous_half(mesh_.twin[in]);
            budget_.spend(1);
        }
    }

    /// C, L, R, S: changes the border. False when the budget is spent.
    bool advance(Clers symbol, std::uint32_t k, std::uint32_t at)
    {
        if (symbol == Clers::C) gate_ = border_.add(gate_, k);
        if (symbol == Clers::R) gate_ = border_.close_right(gate_, k);
        if (symbol == Clers::L) gate_ = border_.close_left(gate_, k);
        if (symbol != Clers::S) return true;
        const bool split = on_own_border(at);
        if (!split) merge(at);
        border_.join(gate_, k, at);
        if (split) {
            stack_.push_back(3 * k + 2);
            waiting_[3 * k + 2] = true;
        }
        gate_ = 3 * k + 1;
        return budget_.spend(0);
    }

    /// Searches the gate's border from both sides, so that the cost is the smaller part.
    bool on_own_border(std::uint32_t at)
    {
        std::uint32_t right = border_.next(gate_), left = border_.previous(gate_);
        for (; budget_.spend(2); right = border_.next(right), left = border_.previous(left)) {
            if (right == at || left == at) return true;
            if (right == left || border_.next(right) == left) break;
        }
        return false;
    }

    void merge(std::uint32_t at)
    {
        Merge merge{static_cast<std::uint32_t>(result_.string.symbols.size() - 1), 0, 0, 1};
        std::uint32_t other = at;
        for (; !waiting_[other] && budget_.spend(2); other = border_.previous(other)) ++merge.position;
        for (std::uint32_t e = border_.next(other); e != other && budget_.spend(2); e = border_.next(e)) ++merge.length;
        if (!budget_.spend(1)) return;
        const auto place = std::find(stack_.rbegin(), stack_.rend(), other);
        merge.depth = static_cast<std::uint32_t>(place - stack_.rbegin());
        budget_.spend(4ul * merge.depth);
        stack_.erase(std::next(place).base());
        waiting_[other] = false;
        result_.string.merges.push_back(merge);
    }

    const ClosedMesh& mesh_;
    Border border_;
    WorkBudget budget_;
    std::vector<std::uint32_t> entered_; ///< [T'] place in the order of conquest
    std::vector<bool> met_;              ///< [copies]
    std::vector<bool> waiting_;          ///< [3T'] border edges that are gates in the stack
    std::vector<std::uint32_t> stack_;   ///< gates of the borders that wait
    std::uint32_t gate_ = none;
    Conquest result_;
};

/// Lengths of the two borders that an S leaves.
struct Split {
    std::uint64_t right = 0, left = 0;
};

Error malformed(const char* what)
{
    return bad_input(what, "clers");
}

/// Where each component's symbols end. @fails bad_input: the last component does not end.
Result<std::vector<std::size_t>> component_ends(const ClersString& string)
{
    std::vector<std::size_t> ends;
    std::uint64_t open = 1;
    auto merge = string.merges.begin();
    for (std::size_t i = 0; i < string.symbols.size(); ++i) {
        const bool merges = merge != string.merges.end() && merge->symbol == i;
        if (merges) ++merge;
        if (merges && (string.symbols[i] != Clers::S || open < 2)) return malformed("a merge where none can be");
        if (merges || string.symbols[i] == Clers::E)
            --open;
        else if (string.symbols[i] == Clers::S)
            ++open;
        if (open != 0) continue;
        ends.push_back(i + 1);
        open = 1;
    }
    if (merge != string.merges.end()) return malformed("a merge beyond the string");
    if (ends.empty() ? !string.symbols.empty() : ends.back() != string.symbols.size())
        return malformed("the string ends before its last border does");
    if (ends.size() + string.symbols.size() != string.triangle_count) return malformed("the triangle count disagrees");
    return ends;
}

/// Follows the borders' lengths from the end of the string to its beginning: there each is known to be 3.
class Measure {
public:
    Measure(const ClersString& string, WorkBudget& budget) : string_(string), budget_(budget) {}

    /// The splits in the order of the string.
    Result<std::vector<Split>> run()
    {
        MESHREEL_TRY(const std::vector<std::size_t> ends, component_ends(string_));
        merge_ = string_.merges.size();
        for (std::size_t c = ends.size(); c-- > 0;) {
            lengths_.clear();
            for (std::size_t i = ends[c]; i-- > (c > 0 ? ends[c - 1] : 0);)
                if (!undo(i)) return malformed("the borders' lengths do not come out");
            if (lengths_.size() != 1 || lengths_[0] != 3) return malformed("the borders' lengths do not come out");
        }
        std::reverse(splits_.begin(), splits_.end());
        return std::move(splits_);
    }

private:
    bool undo(std::size_t i)
    {
        const Clers symbol = string_.symbols[i];
        if (symbol == Clers::E) {
            lengths_.push_back(3);
            return true;
        }
        if (lengths_.empty()) return false;
        if (symbol == Clers::C) return --lengths_.back() >= 2;
        if (symbol == Clers::L || symbol == Clers::R) {
            ++lengths_.back();
            return true;
        }
        if (merge_ > 0 && string_.merges[merge_ - 1].symbol == i) return undo_merge(string_.merges[--merge_]);
        if (lengths_.size() < 2) return false;
        const Split split{lengths_.back(), lengths_[lengths_.size() - 2]};
        splits_.push_back(split);
        lengths_.pop_back();
        lengths_.back() = split.right + split.left - 1;
        return true;
    }

    bool undo_merge(const Merge& merge)
    {
        if (merge.length < 2 || merge.position >= merge.length || lengths_.back() < merge.length + 3ul) return false;
        if (merge.depth >= lengths_.size() || !budget_.spend(merge.depth)) return false;
        lengths_.back() -= merge.length + 1ul;
        lengths_.insert(lengths_.end() - 1 - merge.depth, merge.length);
        return true;
    }

    const ClersString& string_;
    WorkBudget& budget_;
    std::size_t merge_ = 0;
    std::vector<std::uint64_t> lengths_;
    std::vector<Split> splits_;
};

class Rebuilder {
public:
    Rebuilder(const ClersString& string, WorkBudget& budget)
        : string_(string), budget_(budget), border_(string.triangle_count)
    {
        triangles_.reserve(string.triangle_count);
    }

    /// @param splits as measured; they make every step below sound.
    Result<std::vector<Triangle>> run(const std::vector<Split>& splits)
    {
        split_ = splits.begin();
        bool inside = false;
        for (std::uint32_t i = 0; i < string_.symbols.size(); ++i) {
            if (!inside) begin();
            inside = step(i);
            if (!budget_.spend(0)) return malformed("the string takes too many steps");
        }
        return std::move(triangles_);
    }

private:
    void begin()
    {
        triangles_.push_back({vertices_, vertices_ + 1, vertices_ + 2});
        vertices_ += 3;
        gate_ = border_.begin(static_cast<std::uint32_t>(triangles_.size() - 1));
    }

    std::uint32_t left_end(std::uint32_t edge) const { return triangles_[edge / 3][(edge + 1) % 3]; }
    std::uint32_t right_end(std::uint32_t edge) const { return triangles_[edge / 3][edge % 3]; }

    /// The edge `count` places to the right (or, negative, to the left) of `edge`.
    std::uint32_t walk(std::uint32_t edge, std::uint64_t to_right, std::uint64_t to_left)
    {
        if (!budget_.spend(std::min(to_right, to_left))) return edge;
        if (to_right <= to_left)
            for (; to_right > 0; --to_right) edge = border_.next(edge);
        else
            for (; to_left > 0; --to_left) edge = border_.previous(edge);
        return edge;
    }

    /// Adds the triangle of symbol i; false when the component is complete.
    bool step(std::uint32_t i)
    {
        const auto k = static_cast<std::uint32_t>(triangles_.size());
        const Clers symbol = string_.symbols[i];
        std::uint32_t tip = none, at = none;
        bool merged = false;
        if (symbol == Clers::C) tip = vertices_++;
        if (symbol == Clers::L) tip = left_end(border_.previous(gate_));
        if (symbol == Clers::R || symbol == Clers::E) tip = right_end(border_.next(gate_));
        if (symbol == Clers::S) {
            merged = merge_ < string_.merges.size() && string_.merges[merge_].symbol == i;
            at = merged ? take_merged() : walk(gate_, split_->right, split_->left - 1);
            tip = left_end(at);
        }
        triangles_.push_back({left_end(gate_), right_end(gate_), tip});
        if (symbol == Clers::E) {
            if (stack_.empty()) return false;
            gate_ = stack_.back();
            stack_.pop_back();
            return true;
        }
        advance(symbol, k, at);
        if (symbol == Clers::S && !merged) {
            stack_.push_back(3 * k + 2);
            ++split_;
        }
        return true;
    }

    void advance(Clers symbol, std::uint32_t k, std::uint32_t at)
    {
        if (symbol == Clers::C) gate_ = border_.add(gate_, k);
        if (symbol == Clers::R) gate_ = border_.close_right(gate_, k);
        if (symbol == Clers::L) gate_ = border_.close_left(gate_, k);
        if (symbol != Clers::S) return;
        border_.join(gate_, k, at);
        gate_ = 3 * k + 1;
    }

    /// Takes the next merge's border out of the stack; returns the edge at the tip.
    std::uint32_t take_merged()
    {
        const Merge& merge = string_.merges[merge_++];
        const auto place = stack_.end() - 1 - merge.depth;
        const std::uint32_t gate = *place;
        stack_.erase(place);
        budget_.spend(merge.depth);
        return walk(gate, merge.position, merge.length - merge.position);
    }

    const ClersString& string_;
    WorkBudget& budget_;
    Border border_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> stack_;
    std::vector<Split>::const_iterator split_;
    std::size_t merge_ = 0;
    std::uint32_t vertices_ = 0;
    std::uint32_t gate_ = none;
};

} // namespace

std::uint64_t ClersString::raw_bits() const
{
    std::uint64_t bits = 0;
    for (const Clers symbol : symbols) bits += symbol == Clers::C ? 1 : 3;
    return bits;
}

std::optional<Conquest> conquer(const ClosedMesh& mesh)
{
    return Conqueror(mesh).run();
}

Result<std::vector<Triangle>> rebuild(const ClersString& string)
{
    WorkBudget budget(string.triangle_count);
    MESHREEL_TRY(const std::vector<Split> splits, Measure(string, budget).run());
    return Rebuilder(string, budget).run(splits);
}

} // namespace meshreel::connectivity
