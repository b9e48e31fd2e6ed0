"""Recursive least squares, as reel and lossless learn: src/meshreel/codecs/reel.md, "First components".

SPDX-License-Identifier: MIT
"""

import numpy

from surface import Adjacency, after, before


def bounded(value):
    return value if -1e30 < value < 1e30 else 0.0


class LeastSquares:
    def __init__(self, count, memory):
        self.memory, self.w, self.P = memory, numpy.zeros(count), numpy.eye(count)

    def predict(self, u):
        total = 0.0
        for w, x in zip(self.w, u):
            total += float(w) * x
        return total

    def learn(self, u, error):
        gain = numpy.zeros(len(u))
        for j, x in enumerate(u):
            gain = gain + self.P[j] * x
        power = self.memory
        for g, x in zip(gain, u):
            power += float(g) * x
        scale = 1.0 / power
        self.w = self.w + gain * scale * error
        self.P = self.P - gain[:, None] * gain[None, :] * scale
        if max(0.0, *self.P.diagonal()) < 100.0:
            self.P = self.P * (1.0 / self.memory)


def parallelograms(surface):
    """[W] of [(left, right, opposite)], each vertex above all three."""
    mesh, found = Adjacency(surface.triangles), [[] for _ in surface.vertices]
    for h, twin in enumerate(mesh.twin):
        if twin is not None:
            tip, *corners = (mesh.origin(c) for c in (before(h), h, after(h), before(twin)))
            if tip > max(corners):
                found[tip].append(tuple(corners))
    return found
