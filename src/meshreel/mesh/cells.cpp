/// A counting sort by slots, and distances a block at a time.
// SPDX-License-Identifier: MIT
#include "meshreel/mesh/cells.h"

#include "meshreel/base/wide.h"

namespace meshreel {

namespace {

#ifdef MESHREEL_DECODER_ALONE
constexpr std::size_t few = 0; // counting ranks pays in wide registers, which it has not
#else
constexpr std::size_t few = 64; ///< of which all ranks are counted
#endif

/// Of each how many are smaller; squares and ranks are read and written up to a multiple of 4.
MESHREEL_WIDE void ranks_of(const double* __restrict squares, std::size_t count, double* __restrict ranks)
{
    for (std::size_t i = 0; i < count; i += 4)
        for (std::size_t l = 0; l < 4; ++l) ranks[i + l] = 0;
    for (std::size_t j = 0; j < count; ++j)
        for (std::size_t i = 0; i < count; i += 4)
            for (std::size_t l = 0; l < 4; ++l) ranks[i + l] += squares[j] < squares[i + l] ? 1.0 : 0.0;
}

/// Without a branch that depends on a distance. @return whether no two were equally near; else nothing is done.
bool ranked(const Cells::Found& found, std::span<std::uint32_t> nearest)
{
    std::array<double, few> ranks;
    std::array<std::uint32_t, few> places;
    ranks_of(found.squares.data(), found.count, ranks.data());
    std::size_t sum = 0;
    for (std::size_t i = 0; i < found.count; ++i) {
        const auto rank = static_cast<std::size_t>(ranks[i]);
        places[rank] = found.points[i];
        sum += rank;
    }
    if (2 * sum != found.count * (found.count - 1)) return false; // some places nobody has
    std::copy_n(places.data(), nearest.size(), nearest.data());
    return true;
}

} // namespace

std::size_t Cells::Found::sorted(std::span<std::uint32_t> nearest) const
{
    const std::size_t wanted = std::min(count, nearest.size());
    if (count <= few && ranked(*this, nearest.first(wanted))) return wanted;
    std::vector<double> best(wanted);
    std::size_t held = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto before = [&](std::size_t place) { // of those held, whether the i-th is nearer
            return squares[i] != best[place] ? squares[i] < best[place] : points[i] < nearest[place];
        };
        if (held == wanted && (wanted == 0 || !before(wanted - 1))) continue;
        std::size_t place = held < wanted ? held++ : wanted - 1;
        for (; place > 0 && before(place - 1); --place) {
            best[place] = best[place - 1];
            nearest[place] = nearest[place - 1];
        }
        best[place] = squares[i];
        nearest[place] = points[i];
    }
    return wanted;
}

void Cells::fill(std::span<const Point> points, double reach)
{
    scale_ = 1.0 / (1.001 * reach); // a little more, for what is rounded
    while (shift_ > 32 && std::size_t{1} << (64 - shift_) < 2 * points.size()) --shift_;
    begins_.assign((std::size_t{1} << (64 - shift_)) + 1, 0);
    cubes_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Cube cube = cube_of(points[i]);
        cubes_[i].row = row_of(cube[1], cube[2]);
        cubes_[i].slot = static_cast<std::uint32_t>(slot(cubes_[i].row, cube[0]));
        ++begins_[cubes_[i].slot];
    }
    for (std::size_t s = 1; s < begins_.size(); ++s) begins_[s] += begins_[s - 1]; // where slots end, so far
    held_.resize(points.size());
    for (std::vector<double>& coordinates : at_) coordinates.resize(points.size() + block);
    for (std::size_t i = points.size(); i-- > 0;) {
        const std::size_t place = --begins_[cubes_[i].slot];
        held_[place] = {cubes_[i].row, static_cast<std::uint32_t>(i)};
        for (std::size_t c = 0; c < 3; ++c) at_[c][place] = points[i][c];
    }
}

void Cells::near(const Point& place, std::size_t limit, double bound, Found& found) const
{
    const Cube middle = cube_of(place);
    found.count = 0;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 3; ++j) {
            const Search search{place, row_of(middle[1] + j - 1, middle[2] + k - 1), limit, bound};
            const std::size_t first = slot(search.row, middle[0] - 1), mask = begins_.size() - 2;
            if (first + 2 <= mask)
                look(search, begins_[first], begins_[first + 3], found);
            else
                for (std::size_t i = 0; i < 3; ++i)
                    look(search, begins_[(first + i) & mask], begins_[((first + i) & mask) + 1], found);
        }
}

void Cells::look(const Search& search, std::size_t begin, std::size_t end, Found& found) const
{
    if (found.squares.size() < found.count + (end - begin) + block) {
        found.squares.resize(2 * (found.count + (end - begin) + block));
        found.points.resize(found.squares.size());
    }
    std::size_t count = found.count;
    double* __restrict to_squares = found.squares.data();
    std::uint32_t* __restrict to_points = found.points.data();
    for (; begin < end; begin += block) {
        const Squares squares = squares_from(begin, search.place);
        const Held* __restrict held = held_.data() + begin;
        for (std::size_t i = 0; i < std::min(end - begin, block); ++i) { // no branch: it could not be foreseen
            to_squares[count] = squares[i];
            to_points[count] = held[i].index;
            count += static_cast<std::size_t>(squares[i] <= search.bound) &
                     static_cast<std::size_t>(held[i].index < search.limit) &
                     static_cast<std::size_t>(held[i].row == search.row);
        }
    }
    found.count = count;
}

MESHREEL_WIDE Cells::Squares Cells::squares_from(std::size_t begin, const Point& place) const
{
    const double* __restrict x = at_[0].data() + begin;
    const double* __restrict y = at_[1].data() + begin;
    const double* __restrict z = at_[2].data() + begin;
    Squares squares;
    for (std::size_t i = 0; i < block; ++i) { // squared_gap, in wide registers
        const double dx = place[0] - x[i], dy = place[1] - y[i], dz = place[2] - z[i];
        squares[i] = dx * dx + dy * dy + dz * dz;
    }
    return squares;
}

} // namespace meshreel
