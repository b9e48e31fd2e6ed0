"""The codec lossless: src/meshreel/codecs/lossless.md.

SPDX-License-Identifier: MIT
"""

import math
import struct

import numpy

from coding import Models, RangeDecoder, octave_column
from learning import LeastSquares, parallelograms

LARGEST = 0x7F7FFFFF
FARTHEST = float(1 << 52)
TENS = [1.0]
while len(TENS) < 80:
    TENS.append(TENS[-1] * 10.0)


def place_of(x):
    bits = struct.unpack("<I", struct.pack("<f", x))[0]
    return -1 - (bits & 0x7FFFFFFF) if bits >> 31 else bits


def float_at(place):
    bits = min(-1 - place if place < 0 else place, LARGEST) | (1 << 31 if place < 0 else 0)
    return struct.unpack("<f", struct.pack("<I", bits))[0]


def f32(x):
    most = float_at(LARGEST)
    return 0.0 if x != x else float(numpy.float32(min(max(x, -most), most)))


def float_step(x):
    exponent = (struct.unpack("<Q", struct.pack("<d", x))[0] >> 52 & 0x7FF) - 1023
    return math.ldexp(1.0, min(max(exponent, -126), 127) - 23)


class Floats:
    """All float32, in their order."""

    decimal = False
    at = staticmethod(float_at)
    step = staticmethod(float_step)

    @staticmethod
    def position(x):
        below = f32(x)
        place = place_of(below) + (x - below) / float_step(x)
        return min(max(place, -FARTHEST), FARTHEST) if place == place else 0.0


class Decimals:
    """Numbers that came out of a text."""

    decimal = True

    def __init__(self, fields, name):
        self.scale, self.offset = fields.number(name + ".scale"), fields.number(name + ".offset")
        self.digits, self.decimals = fields.u8(name + ".digits", 15, 1), fields.u8(name + ".decimals", 22)
        if self.scale == 0:
            fields.refuse(name + ".scale", "is 0")

    def at(self, n):
        limit, size = 10**self.digits, min(abs(n), 1 << 52)
        between = limit - limit // 10
        k = 0 if size < limit else min((size - limit) // between + 1, 60)
        m = size if k == 0 else limit // 10 + (size - limit) - (k - 1) * between
        after_point = self.decimals - k
        D = float(m) / TENS[after_point] if after_point >= 0 else float(m) * TENS[-after_point]
        return f32(self.scale * f32(-D if n < 0 else D) + self.offset)

    def grown(self, x):
        """(E, y, k)"""
        E, k = (x - self.offset) / self.scale, 0
        y = abs(E) * TENS[self.decimals]
        if not y < 1e75:
            return E, None, 0
        while y >= TENS[self.digits] * TENS[k] and k < 60:
            k += 1
        return E, y, k

    def position(self, x):
        E, y, k = self.grown(x)
        if y is None:
            return 0.0
        place = y / TENS[k]
        if k > 0:
            place += 0.9 * TENS[self.digits] * k
        place = min(place, FARTHEST)
        return -place if E < 0 else place

    def step(self, x):
        _, y, k = self.grown(x)
        return abs(self.scale) if y is None else abs(self.scale / TENS[self.decimals] * TENS[k])


class Ring:
    """Every vertex' neighbours, earlier and later ones, and its parallelograms."""

    def __init__(self, surface):
        beside = [set() for _ in surface.vertices]
        for corners in surface.triangles:
            if len(set(corners)) == 3:
                for v in corners:
                    beside[v].update(corners)
        self.earlier = [sorted(u for u in all if u < v) for v, all in enumerate(beside)]
        self.later = [sorted(u for u in all if u > v) for v, all in enumerate(beside)]
        self.parallelograms = parallelograms(surface)


def mean(values, where):
    total = 0.0
    for u in where:
        total += values[u]
    return total / len(where) if where else 0.0


class Coordinate:
    """One coordinate of all frames, frame after frame."""

    def __init__(self, line, decoder, ring):
        self.line, self.decoder, self.ring, self.models = line, decoder, ring, Models()
        W = len(ring.earlier)
        self.missed, self.wrong = [[0.0] * W for _ in range(3)], [[0.0] * W for _ in range(2)]
        self.corrected, self.learners, self.frames = [0] * W, [LeastSquares(9, 0.999) for _ in range(2)], 0

    def frame(self, before, base):
        """The values of a frame; before, base: of the frame before and of the guess, or None."""
        self.missed = [[0.0] * len(self.corrected)] + self.missed[:2]
        self.wrong = [[0.0] * len(self.corrected), self.wrong[0]]
        now = []
        for v in range(len(self.corrected)):
            if base is not None or before is not None:
                b = base[v] if base is not None else before[v]
            elif self.ring.parallelograms[v]:
                b = self.parallelogram(now, v)
            else:
                b = now[self.ring.earlier[v][-1]] if self.ring.earlier[v] else now[v - 1] if v > 0 else 0.0
            now.append(self.value(v, b))
        self.frames += 1
        return now

    def value(self, v, b):
        line, usual, which = self.line, self.usual_miss(v), min(self.frames, 1)
        unit = 1.0 / (usual + 0.25 * line.step(b))
        u = [x * unit for x in self.features(v)]
        c = self.learners[which].predict(u)
        if not -1e4 < c < 1e4:
            self.learners[which], c = LeastSquares(9, 0.999), 0.0
        g = b + c / unit
        p = line.position(g)
        n = int(p - 0.5 if p < 0 else p + 0.5)
        x = line.at(self.number(n, p - n, octave_column(2, usual / line.step(g), 128)))
        if line.decimal:
            density = octave_column(0, line.step(x) / float_step(x), 32)
            level = self.decoder.level(self.models, ("corrected", density, self.corrected[v]))
            self.corrected[v] = min(abs(level), 2)
            x = float_at(place_of(x) + level) if level else x
        self.missed[0][v], self.wrong[0][v] = x - b, abs(x - g)
        self.learners[which].learn(u, self.missed[0][v] * unit - c)
        return x

    def number(self, n, d, q):
        part = int(min(abs(d) * 16, 7.0))
        if not self.decoder.decide(self.models["off", q, part]):
            return n
        toward = self.decoder.decide(self.models["toward", q, part])
        width = 1 + self.decoder.symbol(self.models, ("width", q), 40)
        m, told = 1, min(width - 1, 3)
        for _ in range(told):
            m = 2 * m + self.decoder.decide(self.models["high", width, m])
        rest = width - 1 - told
        m = m << rest | self.decoder.raw(rest)
        return n - m if toward == (d < 0) else n + m

    def usual_miss(self, v):
        wrong, earlier, later = self.wrong, self.ring.earlier[v], self.ring.later[v]
        total, weight = 0.0, float(len(earlier))
        for u in earlier:
            total += wrong[0][u]
        if self.frames > 0:
            total += 2 * wrong[1][v]
            for u in later:
                total += 0.5 * wrong[1][u]
            weight += 2 + 0.5 * len(later)
        elif v > 0:
            total, weight = total + wrong[0][v - 1], weight + 1
        return total / weight if weight > 0 else 1.0

    def parallelogram(self, values, v):
        total = 0.0
        for a, b, o in self.ring.parallelograms[v]:
            total += values[a] + values[b] - values[o]
        return total / len(self.ring.parallelograms[v])

    def features(self, v):
        earlier, later, (now, one, two) = self.ring.earlier[v], self.ring.later[v], self.missed
        across = [self.parallelogram(values, v) if self.ring.parallelograms[v] else mean(values, earlier)
                  for values in (now, one)]
        return [mean(now, earlier), across[0], now[v - 1] if v > 0 else 0.0, now[earlier[0]] if earlier else 0.0,
                one[v], mean(one, earlier), mean(one, later), across[1], two[v]]


def frames_of(fields, topology, count, guessed):
    """Positions [F, W, 3] in float64, all of them float32. guessed(codec, fields): the guess, likewise."""
    codec, guess, strands = fields.text("guess_codec", 32).decode("latin1"), None, []
    if codec:
        data = fields.bytes("guess")
        guess = guessed(codec, type(fields)(data, fields.at + fields.place - len(data), "SEGM.guess", fields.memory))
    ring = Ring(topology.surface)
    for axis in "xyz":
        line = Decimals(fields, axis) if fields.u8(axis + ".decimal", 1) else Floats()
        data = fields.bytes(axis + ".bits")
        decoder = RangeDecoder(data, fields.at + fields.place - len(data), f"SEGM.{axis}.bits")
        strands.append(Coordinate(line, decoder, ring))
    fields.done()
    frames = numpy.empty((count, len(ring.earlier), 3))
    for axis, strand in enumerate(strands):
        before = None
        for f in range(count):
            before = strand.frame(before, None if guess is None else guess[f, :, axis].tolist())
            frames[f, :, axis] = before
    return frames
