"""Edge lengths that hardly vary, given back to what was decoded: src/meshreel/codecs/reel.md, "Relaxation".

SPDX-License-Identifier: MIT
"""

import numpy

import pca

ROUNDS, R2 = 8, 0.95 * 0.95


def length(e):
    return numpy.sqrt(e[:, 0] * e[:, 0] + e[:, 1] * e[:, 1] + e[:, 2] * e[:, 2])


class Relaxation:
    def __init__(self, triangles, mean, B):
        pairs = {(min(a, b), max(a, b)) for t in triangles for a, b in zip(t, t[1:] + t[:1]) if a != b}
        self.edges, self.mean, self.B, self.F = sorted(pairs), mean, B, len(mean) // 3

    def relax(self, C, noise):
        """C [W, K] afterwards; noise: the variance N."""
        decoded = self.frames(C)
        for assumed in (noise, 0.0):
            start = self.frames(C)
            x = self.rounds(decoded, start, self.springs(start, noise, assumed))
            C = self.moved(C, [a - b for a, b in zip(x, start)])
        return C

    def frames(self, C):
        """[W] of positions [F, 3]"""
        posed = pca.frames_of(self.mean, self.B, C)
        return [posed[:, v] for v in range(posed.shape[1])]

    def springs(self, x, noise, assumed):
        """[(i, j, w, L)]"""
        found = []
        for i, j in self.edges:
            lengths = length(x[i] - x[j]).tolist()
            a = b = 0.0
            for one in lengths:
                d = one - lengths[0]
                a, b = a + d, b + d * d
            s = max(0.0, b / self.F - (a / self.F) * (a / self.F))
            w = min(10.0, 0.5 * noise / max(s - assumed, 1e-30))
            found.append((i, j, w, lengths[0] + a / self.F))
        return found

    @staticmethod
    def rounds(p, start, springs):
        stiffness = [1.0] * len(p)
        for i, j, w, _ in springs:
            stiffness[i] += 2 * w
            stiffness[j] += 2 * w
        x = before = start
        omega = 1.0
        for turn in range(ROUNDS):
            omega = (1.0, 2 / (2 - R2))[turn] if turn < 2 else 4 / (4 - R2 * omega)
            g = [numpy.zeros_like(one) for one in x]
            for i, j, w, L in springs:
                e = x[i] - x[j]
                there = length(e)
                there[there == 0] = 1.0
                pull = (w * (1 - L / there))[:, None] * e
                g[i], g[j] = g[i] + pull, g[j] - pull
            y = [xi - 1.8 / s * ((xi - pi) + gi) for xi, pi, gi, s in zip(x, p, g, stiffness)]
            x, before = [b + omega * (yi - b) for yi, b in zip(y, before)], x
        return x

    def moved(self, C, shift):
        """C and what shift [W] of [F, 3] is in terms of B."""
        C, B = numpy.array(C), numpy.array(self.B).reshape(len(self.B), -1)
        total = numpy.zeros_like(C)
        for first in range(0, self.F, 8):
            for axis in range(3):
                for f in range(first, min(first + 8, self.F)):
                    d = numpy.array([one[f, axis] for one in shift])
                    total = total + d[:, None] * B[None, :, axis * self.F + f]
        return C + total
