"""Edge lengths that hardly vary, given back to what was decoded: src/meshreel/codecs/reel.md, "Relaxation".

SPDX-License-Identifier: MIT
"""

import numpy

import pca

ROUNDS, R2 = 8, 0.95 * 0.95


class Relaxation:
    def __init__(self, triangles, mean, B):
        pairs = {(min(a, b), max(a, b)) for t in triangles for a, b in zip(t, t[1:] + t[:1]) if a != b}
        self.edges, self.mean, self.B, self.F = numpy.array(sorted(pairs), int).reshape(-1, 2), mean, B, len(mean) // 3

    def relax(self, C, noise):
        """C [W, K] afterwards; noise: the variance N."""
        decoded = self.frames(C)
        for assumed in (noise, 0.0):
            start = self.frames(C)
            x = self.rounds(decoded, start, *self.springs(start, noise, assumed))
            C = self.moved(C, x - start)
        return C

    def frames(self, C):
        """Positions [W, F, 3]."""
        return pca.frames_of(self.mean, self.B, C).transpose(1, 0, 2)

    def along(self, x):
        """What edges are as vectors [E, F, 3], and their lengths [E, F]."""
        e = x[self.edges[:, 0]] - x[self.edges[:, 1]]
        return e, numpy.sqrt(e[..., 0] * e[..., 0] + e[..., 1] * e[..., 1] + e[..., 2] * e[..., 2])

    def added(self, first, at_start, at_end):
        """What edges give to their two ends, edge after edge, on top of `first`."""
        total = numpy.array(first)
        numpy.add.at(total, self.edges.reshape(-1), numpy.stack([at_start, at_end], 1).reshape(-1, *total.shape[1:]))
        return total

    def springs(self, x, noise, assumed):
        """(w [E], L [E])"""
        lengths, a, b = self.along(x)[1], 0.0, 0.0
        for d in (lengths - lengths[:, :1]).T:
            a, b = a + d, b + d * d
        s = numpy.fmax(0.0, b / self.F - (a / self.F) * (a / self.F))
        return numpy.fmin(10.0, 0.5 * noise / numpy.fmax(s - assumed, 1e-30)), lengths[:, 0] + a / self.F

    def rounds(self, p, start, w, L):
        stiffness = self.added(numpy.ones(len(p)), 2 * w, 2 * w)
        x, before, omega = start, start, 1.0
        for turn in range(ROUNDS):
            omega = (1.0, 2 / (2 - R2))[turn] if turn < 2 else 4 / (4 - R2 * omega)
            e, there = self.along(x)
            there[there == 0] = 1.0
            pull = (w[:, None] * (1 - L[:, None] / there))[..., None] * e
            g = self.added(numpy.zeros_like(x), pull, -pull)
            y = x - (1.8 / stiffness)[:, None, None] * ((x - p) + g)
            x, before = before + omega * (y - before), x
        return x

    def moved(self, C, shift):
        """C and what shift [W, F, 3] is in terms of B."""
        C, B = numpy.array(C), numpy.array(self.B)
        total = numpy.zeros_like(C)
        for first in range(0, self.F, 8):
            for axis in range(3):
                for f in range(first, min(first + 8, self.F)):
                    total = total + shift[:, f, axis, None] * B[None, :, axis * self.F + f]
        return C + total
