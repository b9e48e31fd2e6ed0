"""A triangle list's own order and numbers, found again from the shell's: docs/connectivity.md, "Order".

SPDX-License-Identifier: MIT
"""

from bisect import bisect_left

from coding import Mixers, Models, mixed
from surface import NONE, Adjacency, after, before


class Tries:
    """Candidates tried in turn: docs/connectivity.md, "Candidates"."""

    def __init__(self, reader):
        self.reader, self.models, self.mixers, self.orders = reader, Models(), Mixers(6), {}

    def decide(self, kind, contexts):
        models = []
        for i, c in enumerate(contexts):
            number = ((c * 0x9E3779B1 & NONE) ^ (8 * kind + i)) * 2654435761 & NONE
            models.append(self.models[number >> 16])
        return mixed(self.reader, models, self.mixers[kind])

    def right(self, order_of, candidates, contexts, base=0):
        """(kind, candidate), or (how many kinds, None). contexts(candidate, alike, near) are six numbers."""
        order = self.orders.setdefault(order_of, list(range(len(candidates))))
        tried = set()
        for place, kind in enumerate(order):
            value = candidates[kind]
            if value is None or value in tried:
                continue
            tried.add(value)
            alike = candidates.count(value)
            if self.decide(base + kind, contexts(value, min(alike, 3), min(place, 3))):
                order[place], order[place // 2] = order[place // 2], order[place]
                return kind, value
        return len(candidates), None


class Walked:
    """The shell's mesh, and what is known of the order so far."""

    def __init__(self, vertices, shell):
        self.mesh = Adjacency(shell)
        self.number, self.vertex, self.corner = [NONE] * vertices, {}, {}
        for h in range(3 * len(shell)):
            self.corner.setdefault(self.mesh.origin(h), h)
        self.unvisited, self.unused = list(range(len(shell))), list(range(vertices))
        self.stamp, self.stamped, self.frontier = {}, [], []

    def number_at(self, half):
        return self.number[self.mesh.origin(half)]

    def across(self, half):
        twin = None if half is None else self.mesh.twin[half]
        return None if twin is None else twin // 3

    def is_unvisited(self, t):
        place = bisect_left(self.unvisited, t)
        return place < len(self.unvisited) and self.unvisited[place] == t

    def around(self, half, even):
        for _ in range(12):
            if half is None:
                return None
            if self.is_unvisited(half // 3):
                return half // 3
            half = self.mesh.twin[half if even else before(half)]
            if even and half is not None:
                half = after(half)
        return None

    def at_number(self, number):
        if number & NONE not in self.vertex:
            return None
        corner = self.corner[self.vertex[number & NONE]]
        found = self.around(corner, False)
        return self.around(corner, True) if found is None else found

    def visit(self, t):
        del self.unvisited[bisect_left(self.unvisited, t)]
        if t in self.stamp:
            del self.frontier[bisect_left(self.frontier, self.stamp[t])]
        for h in range(3 * t, 3 * t + 3):
            other = self.across(h)
            if other is not None and other not in self.stamp and self.is_unvisited(other):
                self.stamp[other] = len(self.stamped)
                self.stamped.append(other)
                self.frontier.append(self.stamp[other])

    def give(self, half, number):
        self.number[self.mesh.origin(half)], self.vertex[number] = number, self.mesh.origin(half)
        del self.unused[bisect_left(self.unused, number)]

    def beside(self, t):
        """Triangles of the frontier that came to it next after and last before t did."""
        if t not in self.stamp:
            return None, None
        low, high = bisect_left(self.frontier, self.stamp[t]), bisect_left(self.frontier, self.stamp[t] + 1)
        return (self.stamped[self.frontier[high]] if high < len(self.frontier) else None,
                self.stamped[self.frontier[low - 1]] if low > 0 else None)


class Order:
    """Triangle after triangle of the list."""

    def __init__(self, reader, walked):
        self.reader, self.walked, self.models = reader, walked, Models()
        choice = reader.raw(3)
        self.reference, self.from_last = choice >> 1, choice & 1
        self.triangles, self.corners, self.names = Tries(reader), Tries(reader), Tries(reader)
        self.past, self.p, self.q = [None, None], [NONE] * 3, [NONE] * 4
        self.far, self.g, self.e = None, [32] * 4, [9] * 3
        self.turns, self.last_new, self.new_before = 0, NONE, NONE

    def next(self):
        t = self.triangle()
        first = 3 * t + self.first_corner(t)
        self.walked.visit(t)
        corners = [first, after(first), before(first)]
        if self.walked.mesh.flipped[t]:
            corners[1:] = corners[:0:-1]
        for j, corner in enumerate(corners):
            if self.walked.number_at(corner) == NONE:
                self.name(corners, j)
            self.p[j] = self.walked.number_at(corner)
        self.past = [first, self.past[0]]
        self.q = [self.p[0]] + self.q[:3]
        return tuple(self.p)

    def candidates(self):
        walked, h = self.walked, self.past[0]
        found = [None] * 32
        found[24] = walked.unvisited[0]
        if h is None:
            return found
        for i, edge in enumerate((h, after(h), before(h))):
            twin = walked.mesh.twin[edge]
            found[i] = walked.across(edge)
            if twin is not None:
                found[3 + 2 * i], found[4 + 2 * i] = walked.across(after(twin)), walked.across(before(twin))
            found[12 + 2 * i], found[13 + 2 * i] = walked.around(edge, True), walked.around(edge, False)
        h = self.past[1]
        if h is not None:
            found[9:12] = [walked.across(edge) for edge in (h, after(h), before(h))]
        p, q = self.p, self.q
        numbers = {18: p[0] + 1, 19: p[0] - 1, 20: p[1] + 1, 21: self.last_new,
                   30: 2 * q[0] - q[1], 31: 2 * q[1] - q[3]}
        for kind, number in numbers.items():
            found[kind] = walked.at_number(number)
        before_this = self.past[0] // 3
        if walked.frontier:
            found[22], found[23] = walked.stamped[walked.frontier[-1]], walked.stamped[walked.frontier[0]]
            found[26:30] = walked.beside(before_this) + walked.beside(self.far)
        found[25] = before_this + 1
        return [t if t is not None and walked.is_unvisited(t) else None for t in found]

    def triangle(self):
        walked, g = self.walked, self.g

        def contexts(t, alike, near):
            halves = range(3 * t, 3 * t + 3)
            numbered = sum(walked.number_at(h) != NONE for h in halves)
            beside = sum(walked.across(h) is None or not walked.is_unvisited(walked.across(h)) for h in halves)
            f = ((4 * alike + numbered) * 4 + beside) * 4 + near
            two = 64 * g[0] + g[1]
            three = 64 * two + g[2]
            return g[0], two, three, 64 * three + g[3], f, 256 * two + f

        kind, t = self.triangles.right(g[0], self.candidates(), contexts)
        if t is None:
            t = self.far = self.far_triangle()
        self.g = [kind] + g[:3]
        return t

    def far_triangle(self):
        walked = self.walked
        near = int(bool(walked.frontier) and self.reader.decide(self.models["near"]))
        among, start = (walked.frontier, len(walked.frontier) - 1) if near else (walked.unvisited, 0)
        if self.from_last and self.far is not None:
            if not near:
                start = bisect_left(among, self.far)
            elif self.far in walked.stamp:
                start = bisect_left(among, walked.stamp[self.far])
        rank = start + self.reader.jump(self.models, ("far", near))
        if not 0 <= rank < len(among):
            self.reader.refuse("order", "a triangle beyond the last")
        return walked.stamped[among[rank]] if near else among[rank]

    def first_corner(self, t):
        g, signs = self.g, []
        for i in range(3):
            number = self.walked.number_at(3 * t + i)
            signs.append(NONE - 1 if number == NONE else self.p.index(number) if number in self.p else number + 3)
        base = signs.index(min(signs))
        n = [self.walked.number_at(3 * t + (base + i) % 3) for i in range(3)]
        known = sum((n[i] != NONE) << 2 - i for i in range(3))
        order = (n[0] < n[1]) + 2 * (n[1] < n[2]) + 4 * (n[2] < n[0])
        shape = (8 * known + order) * 4 + min(min(signs), 3)
        contexts = (g[0], 64 * g[0] + g[1], shape, 64 * shape + g[0],
                    64 * (self.turns % 64) + g[0], 256 * (self.turns % 16) + shape)
        turn = 0 if self.corners.decide(0, contexts) else 1 if self.corners.decide(1, contexts) else 2
        self.turns = 4 * self.turns + turn & NONE
        return (base + turn) % 3

    def guesses(self, corners, j):
        walked = self.walked
        edge = after(corners[j])
        twin, across = walked.mesh.twin[edge], NONE
        if twin is not None:
            a, b, c = (walked.number_at(h) for h in (edge, after(edge), before(twin)))
            across = NONE if NONE in (a, b, c) else a + b - c
        last, next_one = (walked.number_at(corners[(j + i) % 3]) for i in (2, 1))
        found = [walked.unused[0], self.last_new + 1, self.last_new - 1, across]
        for n in (last, next_one):
            found += [NONE, NONE] if n == NONE else [n + 1, n - 1]
        found.append(2 * self.last_new - self.new_before)
        vertices = len(walked.number)
        return [n & NONE if n & NONE < vertices and n & NONE not in walked.vertex else None for n in found]

    def name(self, corners, j):
        """Finds the number of a vertex that has none."""
        walked, e = self.walked, self.e
        if not walked.unused:
            self.reader.refuse("order", "more vertices than numbers")
        now = 3 * self.g[0] + j

        def contexts(_, alike, near):
            f = 4 * alike + near
            two = 16 * e[0] + e[1]
            return now, 4 * e[0] + j, two * 4 + j, 4 * f + j, (two * 16 + e[2]) * 128 + now, (128 * e[0] + now) * 16 + f

        kind, number = self.names.right(j, self.guesses(corners, j), contexts)
        if number is None:
            number = self.far_number(corners, j)
        self.e = [kind] + e[:2]
        self.new_before, self.last_new = self.last_new, number
        walked.give(corners[j], number)

    def far_number(self, corners, j):
        start = NONE if self.reference == 0 else self.last_new
        if self.reference == 2:
            known = [self.walked.number_at(corners[(j + i) % 3]) for i in (2, 1)]
            start = next((n for n in known if n != NONE), start)
        unused = self.walked.unused
        rank = 0 if start == NONE else bisect_left(unused, start)
        rank += self.reader.jump(self.models, ("number", j))
        if not 0 <= rank < len(unused):
            self.reader.refuse("order", "a number beyond the last")
        return unused[rank]


def read_order(reader, vertices, shell):
    order = Order(reader, Walked(vertices, shell))
    return [order.next() for _ in shell]
