/// Neighbours in earlier triangles, by sorting edges: no hash table that a file could choke.
// SPDX-License-Identifier: MIT
#include "meshreel/container/word_walk.h"

#include <algorithm>

namespace meshreel::container {

std::vector<std::uint32_t> earlier_mates(const std::vector<Triangle>& triangles)
{
    struct Side {
        std::uint64_t edge;
        std::uint32_t corner;
    };
    std::vector<Side> sides(triangles.size() * 3);
    for (std::size_t c = 0; c < sides.size(); ++c) {
        const Triangle& triangle = triangles[c / 3];
        const std::uint64_t a = triangle[(c + 1) % 3], b = triangle[(c + 2) % 3]; // c = 3t + i: the two other corners
        sides[c] = {std::min(a, b) << 32 | std::max(a, b), static_cast<std::uint32_t>(c)};
    }
    std::ranges::sort(
        sides, [](const Side& x, const Side& y) { return x.edge != y.edge ? x.edge < y.edge : x.corner < y.corner; });
    std::vector<std::uint32_t> mates(sides.size(), nothing);
    for (std::size_t i = 1; i < sides.size(); ++i)
        if (sides[i].edge == sides[i - 1].edge) mates[sides[i].corner] = sides[i - 1].corner;
    return mates;
}

namespace {

/// Meets the entries of faces, each once.
class Meeting {
public:
    Meeting(const std::vector<Triangle>& faces, std::uint32_t count)
        : faces_(faces), mates_(earlier_mates(faces)), met_(count)
    {
        guesses_.reserve(count);
    }

    void meet(std::uint32_t corner)
    {
        const Triangle& face = faces_[corner / 3];
        const std::uint32_t i = corner % 3, entry = face[i], next = face[(i + 1) % 3], before = face[(i + 2) % 3];
        if (met_[entry]) return;
        Guess guess{entry, last_met()};
        if (met_[next])
            guess.left = next;
        else if (met_[before])
            guess.left = before;
        if (met_[next] && met_[before] && mates_[corner] != nothing) {
            const std::uint32_t opposite = faces_[mates_[corner] / 3][mates_[corner] % 3];
            if (opposite < met_.size() && met_[opposite]) guess = {entry, next, before, opposite};
        }
        add(guess);
    }
    void meet_rest()
    {
        for (std::uint32_t entry = 0; entry < met_.size(); ++entry)
            if (!met_[entry]) add({entry, last_met()});
    }
    std::vector<Guess> take() { return std::move(guesses_); }

private:
    std::uint32_t last_met() const { return guesses_.empty() ? nothing : guesses_.back().entry; }
    void add(const Guess& guess)
    {
        met_[guess.entry] = true;
        guesses_.push_back(guess);
    }

    const std::vector<Triangle>& faces_;
    std::vector<std::uint32_t> mates_;
    std::vector<bool> met_;
    std::vector<Guess> guesses_;
};

} // namespace

std::vector<Guess> mesh_guesses(const std::vector<Triangle>& faces, std::uint32_t count)
{
    Meeting meeting(faces, count);
    for (std::uint32_t t = 0; t < faces.size(); ++t) {
        const Triangle& face = faces[t];
        if (std::max({face[0], face[1], face[2]}) >= count) continue;
        for (std::uint32_t i = 0; i < 3; ++i) meeting.meet(3 * t + i);
    }
    meeting.meet_rest();
    return meeting.take();
}

std::uint64_t CornerWalk::expected_at(std::uint32_t corner, std::span<const std::uint32_t> words) const
{
    const std::uint32_t t = corner / 3, i = corner % 3, vertex = triangles_[t][i];
    for (std::uint32_t other : {(i + 1) % 3, (i + 2) % 3}) { // the edges at this corner are opposite to the other two
        const std::uint32_t mate = mates_[3 * t + other];
        if (mate == nothing || mate / 3 == t) continue;
        const std::uint32_t base = mate / 3 * 3;
        for (std::uint32_t j = 0; j < 3; ++j)
            if (base + j != mate && triangles_[mate / 3][j] == vertex) return words[base + j];
    }
    return last_of_[vertex];
}

std::uint32_t CornerWalk::residual_of(std::uint32_t word, std::uint64_t expected)
{
    if (word == expected) return 0;
    if (word == next_) return 1;
    const std::uint32_t difference = fold(word - previous_, 4);
    fits_ = fits_ && difference < nothing - 1;
    return difference + 2;
}

std::uint32_t CornerWalk::word_of(std::uint32_t residual, std::uint64_t expected) const
{
    if (residual == 0) return static_cast<std::uint32_t>(expected); // a vertex never seen: a file that we did not write
    return residual == 1 ? next_ : previous_ + unfold(residual - 2, 4);
}

void CornerWalk::remember(std::uint32_t corner, std::uint32_t word)
{
    last_of_[triangles_[corner / 3][corner % 3]] = word;
    if (word >= next_ && word != nothing) next_ = word + 1;
    previous_ = word;
}

} // namespace meshreel::container
