"""Guesses that keep the distances to neighbours: src/meshreel/codecs/reel.md, "Distances kept".

SPDX-License-Identifier: MIT
"""

import numpy

MOST, PASSES, STEPS = 12, 2, 4


def total(terms):
    """The i-th term goes to sum i mod 8."""
    rows = numpy.zeros(-(-len(terms) // 8) * 8)
    rows[:len(terms)] = terms
    s = numpy.zeros(8)
    for row in rows.reshape(-1, 8):
        s = s + row
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]))


def distance(e):
    return numpy.sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2])


class Lengths:
    def __init__(self, mean, B):
        self.mean, self.B, self.F, self.places = numpy.array(mean), numpy.array(B), len(mean) // 3, {}

    def place(self, c):
        """[3F]: x of all frames, then y, then z"""
        posed = self.mean
        for one, row in zip(c, self.B):
            posed = posed + one * row
        return posed

    def know(self, v, c):
        self.places[v] = self.place(c)

    def corrections(self, c, neighbours, known):
        """What to add to components from `known` on, which c [K] has as they are interpolated; None: nothing."""
        if len(neighbours) < 2:
            return None
        p = self.place(c)
        y = [self.places[u] for u in neighbours[:MOST]]
        lengths = self.lengths(p, y)
        step = 1.8 / self.added([w for _, w in lengths])
        x = reached = p
        for turn in range(PASSES):
            if turn > 0:
                c = [one + (self.along(k, x - reached) if k >= known else 0.0) for k, one in enumerate(c)]
                x = reached = self.place(c)
            for _ in range(STEPS):
                x = x - step * ((x - p) + self.slopes(x, y, lengths))
        return [self.along(k, x - p) for k in range(known, len(c))]

    def lengths(self, p, y):
        """[(L, w)]"""
        found = []
        for one in y:
            d = distance((p - one).reshape(3, -1))
            more = d - d[0]
            mean = total(more) / self.F
            found.append((d[0] + mean, max(0.0, total(more * more) / self.F - mean * mean)))
        second = sorted(s for _, s in found)[1]
        return [(L, 8.0 * (3.0 if 3.0 * s <= second else second / s)) for L, s in found]

    @staticmethod
    def added(weights):
        all_of_them = 1.0
        for w in weights:
            all_of_them += w
        return all_of_them

    @staticmethod
    def slopes(x, y, lengths):
        g = numpy.zeros_like(x)
        for one, (L, w) in zip(y, lengths):
            e = (x - one).reshape(3, -1)
            d = distance(e)
            d[d == 0] = 1.0
            g = g + ((w * (1.0 - L / d)) * e).reshape(-1)
        return g

    def along(self, k, shift):
        return total(shift * self.B[k])
