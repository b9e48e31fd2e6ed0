"""The codec reel: src/meshreel/codecs/reel.md.

SPDX-License-Identifier: MIT
"""

from math import sqrt

import numpy

from coding import MixedLevels, RangeDecoder, octave_column
from learning import LeastSquares, bounded, parallelograms
from pca import magnitude, power
from lengths import Lengths
from relaxation import Relaxation

TINY = 5e-324


class Payload:
    """The fields of a SEGM chunk's payload."""

    def __init__(self, fields, frames, W):
        self.fields, self.F, self.W = fields, frames, W
        self.K = fields.varint("bases", 0, 3 * frames)
        if 8 * (self.K + 1) * (6 * frames + 2 * W) > fields.memory[0]:
            fields.refuse("bases", "the basis and its coefficients do not fit in the memory limit")
        self.step, self.first_step, self.basis_step = (
            fields.number(name, low=TINY) for name in ("step", "first_step", "basis_step"))
        self.origin = [fields.number(f"origin_{axis}", "f") for axis in "xyz"]
        self.taper = fields.varint("taper", 0, 256) / 256
        self.linear = fields.number("linear", low=0.0, high=1e6)
        self.squared_bend = fields.number("squared_bend", low=1e-6, high=1e6)
        ways = fields.varint("ways", 0, 3)
        self.contexts, self.lengths = 3 if ways & 1 else 1, ways & 2
        self.neighbours = fields.varint("neighbours", 1, 16)
        self.growth = fields.varint("growth", 1, 10**6)
        self.length_noise = fields.varint("length_noise", 0, 1 << 20)
        basis_size, first_size = fields.varint("basis_size", 0, 1 << 40), fields.varint("first_size", 0, 1 << 40)
        sizes = [fields.varint(f"levels[{i}].bytes", 0, 1 << 40) for i in range(fields.varint("levels", 1, 16))]
        self.level_ends = [sum(sizes[:i + 1]) for i in range(len(sizes))]
        self.at, bits = fields.at + fields.place, fields.rest()
        if basis_size + first_size > len(bits) or len(bits) - basis_size - first_size > self.level_ends[-1]:
            fields.refuse("bits", "ends too early, or goes on after its last level")
        self.basis_bits, self.first_bits = bits[:basis_size], bits[basis_size:basis_size + first_size]
        self.level_bits = bits[basis_size + first_size:]
        if self.K <= 3 and self.level_ends[-1] > 0:
            fields.refuse("levels", "bits of components that there are not")


def dot(a, b):
    total = 0.0
    for x, y in zip(a, b):
        total += x * y
    return total


def kriging(e, linear, squared_bend, noises):
    """Weights [points, n] of differences e [points, known, n], all points at once."""
    points, known, n = e.shape
    G = numpy.zeros((points, n, n))
    for k in range(known):
        G = G + e[:, k, :, None] * e[:, k, None, :]
    own = [G[:, i, i] for i in range(n)]
    total, farthest = numpy.zeros(points), numpy.zeros(points)
    for square in own:
        total, farthest = total + numpy.sqrt(square), numpy.maximum(farthest, square)
    d = numpy.maximum(total / n, 1e-30)
    u, bend = 1.0 / (d * d), sqrt(squared_bend)
    noise = noises[0] + noises[1] / d
    sill = 3 * (numpy.sqrt(squared_bend + 4 * farthest * u) - bend) + bend
    A, side, ones = numpy.zeros((n, n, points)), [], [numpy.ones(points) for _ in range(n)]
    for i in range(n):
        for j in range(i):
            squares = (own[i] + own[j] - 2 * G[:, i, j]) * u
            smooth = sill - numpy.sqrt(squared_bend + numpy.maximum(squares, 0.0))
            A[j, i] = smooth + linear * u * G[:, i, j]
        squares = own[i] * u
        side.append(sill - numpy.sqrt(squared_bend + numpy.maximum(squares, 0.0)))
        A[i, i] = sill - bend + linear * squares + noise
    inverse = []
    for j in range(n):
        inverse.append(1.0 / numpy.maximum(A[j, j], 1e-9))
        for i in range(j + 1, n):
            t = A[j, i] * inverse[j]
            A[i, i:] -= t * A[j, i:]
            side[i], ones[i] = side[i] - t * side[j], ones[i] - t * ones[j]
    for i in range(n - 1, -1, -1):
        side[i], ones[i] = side[i] * inverse[i], ones[i] * inverse[i]
        for k in range(i):
            side[k], ones[k] = side[k] - A[k, i] * side[i], ones[k] - A[k, i] * ones[i]
    free_sum, ones_sum = numpy.zeros(points), numpy.zeros(points)
    for i in range(n):
        free_sum, ones_sum = free_sum + side[i], ones_sum + ones[i]
    lack = (1.0 - free_sum) / ones_sum
    return numpy.stack([f + lack * o for f, o in zip(side, ones)], 1).tolist()


class Coded:
    """Values that levels refine: what is shared by poses and coefficients."""

    def __init__(self, data, at, field, contexts):
        self.decoder = RangeDecoder(data, at, field)
        self.levels = MixedLevels(self.decoder, contexts)

    @staticmethod
    def nearby(seen):
        """The mean of what is seen at the neighbours, the nearest counting most."""
        if not seen:
            return 4.0
        total = shares = 0.0
        for i, size in enumerate(seen):
            total += 1.0 / (1 + i) * size
            shares += 1.0 / (1 + i)
        return total / shares


class Poses(Coded):
    def __init__(self, payload):
        super().__init__(payload.basis_bits, payload.at, "SEGM.basis_bits", 3)
        columns, F = 3 * (payload.K + 1), payload.F
        self.step, self.usual, self.Y = payload.basis_step, [1.0] * columns, []
        windows = (F + 1023) // 1024
        for w in range(windows):
            self.Y += self.window(F * (w + 1) // windows - F * w // windows, columns)

    def window(self, frames, columns):
        Y, seen = [[0.0] * columns for _ in range(frames)], [[0] * columns for _ in range(frames)]
        own, squares, known, first = [1.0] * frames, numpy.zeros((frames, frames)), 3, 0
        while first < columns:
            last = min(columns, 3 if first < 3 else first + 3 * ((first // 3 + 1) // 2))
            for c in range(known, first):
                column = numpy.array([row[c] for row in Y])
                squares = squares + (column[:, None] - column[None, :]) * (column[:, None] - column[None, :])
            known = max(known, first)
            for rank, (f, near, weights) in enumerate(self.order(Y, squares, first)):
                for c in range(first, last):
                    guess = dot(weights, [Y[g][c] for g in near])
                    n, o, u = self.nearby([seen[g][c] for g in near]), own[f], self.usual[c]
                    e = 0.4 * n + 0.35 * o + 0.25 * u
                    places = (20 * octave_column(1, n, 26) + octave_column(1, o, 20),
                              12 * octave_column(1, u, 26) + min(rank.bit_length(), 11), octave_column(2, e, 52))
                    level = self.levels.level(places, 0)
                    Y[f][c] = bounded(guess + level * self.step)
                    size = magnitude(level)
                    seen[f][c] = min(size, 255)
                    own[f] += 0.3 * (size - own[f])
                    self.usual[c] += 0.04 * (size - self.usual[c])
            first = last
        return Y

    @staticmethod
    def order(Y, squares, known):
        """[(frame, its neighbours, their weights)] from coarse to fine, found before any of them is read."""
        F, steps, relevance, E_0 = len(Y), 0.0, [], 0.0
        for f in range(1, F):
            steps += float(squares[f, f - 1])
        squared_pace = steps / (F - 1) if steps > 0 else 1.0
        for c in range(3, known, 3):
            energy = 0.0
            for row in Y:
                energy += row[c] * row[c] + row[c + 1] * row[c + 1] + row[c + 2] * row[c + 2]
            E_0 = energy if c == 3 else E_0
            relevance += [sqrt(sqrt(E_0 / energy)) if energy > 0 and E_0 > 0 else 0.0] * 3
        apart = numpy.subtract.outer(numpy.arange(F, dtype=float), numpy.arange(F, dtype=float))
        square = squares + squared_pace * apart * apart
        order, distance, following = [], numpy.full(F, numpy.inf), 0
        while len(order) < F:
            order.append(following)
            distance = numpy.where(distance >= 0, numpy.minimum(distance, square[following]), distance)
            distance[following] = -1
            following = int(numpy.argmax(distance))
        found, pace = [], sqrt(squared_pace)
        for rank, f in enumerate(order):
            near = sorted(order[:rank], key=lambda g: (square[f, g], g))[:8]
            differences = [[pace * (float(g) - float(f)) for g in near]]
            for k, r in enumerate(relevance):
                differences.append([r * (Y[g][k + 3] - Y[f][k + 3]) for g in near])
            weights = kriging(numpy.array([differences]), 100.0, 1.0, (0.005, 0.0))[0] if near else []
            found.append((f, near, weights))
        return found


class FirstComponents(Coded):
    def __init__(self, payload, surface):
        at = payload.at + len(payload.basis_bits)
        super().__init__(payload.first_bits, at, "SEGM.first_bits", 3)
        self.surface, self.step, self.n = surface, payload.first_step, min(payload.K, 3)
        self.parallelograms = parallelograms(surface)
        W = payload.W
        self.C, self.seen, self.missed = ([[zero] * self.n for _ in range(W)] for zero in (0.0, 0, 0.0))
        self.usual, self.learners = [4.0] * 3, [LeastSquares(11, 0.995) for _ in range(3)]
        for v in range(W):
            own = 0.0
            for k in range(self.n):
                size = self.value(v, k, own)
                own = size if k == 0 else 0.5 * (own + size)

    def plain(self, v, k):
        C, total = self.C, 0.0
        for a, b, o in self.parallelograms[v]:
            total += C[a][k] + C[b][k] - C[o][k]
        if self.parallelograms[v]:
            return total / len(self.parallelograms[v])
        left, right, _ = self.surface.gates[v]
        if right is not None:
            return 0.5 * (C[left][k] + C[right][k])
        return C[left][k] if left is not None else C[v - 1][k] if v > 0 else 0.0

    def value(self, v, k, own):
        """Reads component k of v and returns the level's size."""
        near, plain, amplitude = self.usual[k], self.plain(v, k), 8 * self.step
        if self.parallelograms[v]:
            total = sum(self.seen[x][k] for corners in self.parallelograms[v] for x in corners)
            near = total / (3.0 * len(self.parallelograms[v]))
        whole, guess = self.surface.gates[v][2] is not None, plain
        if whole:
            u = self.features(v, k, plain)
            guess = bounded(plain + amplitude * self.learners[k].predict(u))
        places = (26 * k + octave_column(1, near, 26), 20 * octave_column(1, near, 20) + octave_column(1, own, 20),
                  26 * k + octave_column(1, self.usual[k], 26))
        level = self.levels.level(places, k)
        self.C[v][k] = value = bounded(guess + level * self.step)
        self.missed[v][k] = value - plain
        if whole:
            self.learners[k].learn(u, (value - guess) / amplitude)
        size = magnitude(level)
        self.seen[v][k] = min(size, 255)
        self.usual[k] += 0.02 * (size - self.usual[k])
        return size

    def features(self, v, k, plain):
        a, b, o = self.surface.gates[v]
        C, missed = self.C, self.missed
        ahead, along, missed_ahead, missed_along = 1e-12, 1e-12, 0.0, 0.0
        for j in range(self.n):
            d, e = 0.5 * (C[a][j] + C[b][j]) - C[o][j], C[b][j] - C[a][j]
            m = missed[v][j] if j < k else 0.0
            ahead, along = ahead + d * d, along + e * e
            missed_ahead, missed_along = missed_ahead + m * d, missed_along + m * e
        va, vb, vo = C[a][k], C[b][k], C[o][k]
        u = [va - vo, vb - vo, missed[a][k], missed[b][k], missed[o][k],
             missed_ahead / ahead * (0.5 * (va + vb) - vo), missed_along / along * (vb - va),
             self.bend(a, k), self.bend(b, k), self.bend(o, k), va + vb - vo - plain]
        unit = 1.0 / (8 * self.step)
        return [bounded(x * unit) for x in u]

    def bend(self, x, k):
        left, right, opposite = self.surface.gates[x]
        if opposite is None:
            return 0.0
        return self.C[left][k] + self.C[right][k] - 2 * self.C[opposite][k]


class Order:
    """Vertices from coarse to fine, and for each its candidates among those of earlier levels."""

    def __init__(self, first, wanted):
        X = numpy.zeros((len(first), 3))
        X[:, :len(first[0])] = first
        X = numpy.where((X > -1e100) & (X < 1e100), X, 0.0)
        self.X, self.levels, nearest = X, [], numpy.full(len(X), numpy.inf)
        diagonal = square = self.squared(X.max(0), X.min(0)[None, :])[0]
        square, left = 0.25 * square, numpy.ones(len(X), bool)
        for level in range(160):
            square = 0.0 if level == 159 else square
            taken, v = [], 0
            while True:
                free = numpy.flatnonzero(left[v:] & (nearest[v:] >= square))
                if len(free) == 0:
                    break
                v += int(free[0])
                taken.append(v)
                left[v] = False
                nearest = numpy.minimum(nearest, self.squared(X[v], X))
            self.levels.append(taken)
            square = square / 1.21
        self.order = [v for level in self.levels for v in level]
        self.candidates, before = {}, []
        for level in self.levels:
            for v in level:
                squares = self.squared(X[v], X[before]) if before and diagonal > 0 else numpy.zeros(0)
                self.candidates[v] = [before[i] for i in numpy.argsort(squares, kind="stable")[:wanted]]
            before = before + level

    @staticmethod
    def squared(point, points):
        d = point - points
        return d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]

    def counts(self):
        """How many vertices each level of detail keeps, the coarsest first."""
        ends, counts = numpy.cumsum([len(level) for level in self.levels]).tolist(), [len(self.order)]
        for end in reversed(ends):
            if 24 <= end <= counts[-1] // 4:
                counts.append(end)
        return counts[::-1]


class AllOthers(Coded):
    """The components from 3 on, of the coarsest levels of detail, as many as `keep` says."""

    def __init__(self, payload, first, basis, keep):
        mean, B, energies = basis
        at = payload.at + len(payload.basis_bits) + len(payload.first_bits)
        self.payload, K, W = payload, payload.K, payload.W
        n = payload.neighbours
        self.order = Order(first.C, max(n, 2 * n - min(8, n)))
        counts = self.order.counts()
        if len(counts) != len(payload.level_ends):
            payload.fields.refuse("levels", "another number of levels than its vertices make")
        keep = keep or len(counts)
        end = payload.level_ends[keep - 1]
        if end > len(payload.level_bits):
            payload.fields.refuse("level_bits", "ends too early")
        super().__init__(payload.level_bits[:end], at, "SEGM.level_bits", payload.contexts)
        self.relevance = [1.0] * K
        for k in range(3, K):
            ratio = energies[2] / energies[k] if energies[k] > 0 else 0.0
            self.relevance[k] = sqrt(sqrt(sqrt(ratio)))
        self.C = numpy.zeros((W, K))
        self.C[:, :3] = first.C
        self.seen = [row + [0] * (K - 3) for row in first.seen]
        self.usual, self.own = [1.0] * K, [0.5] * W
        self.lengths = Lengths(mean, B) if payload.lengths else None
        done, passed = 0, 0
        for level in self.order.levels:
            self.level(level, done / W)
            done += len(level)
            if passed < keep and done == counts[passed]:
                if min(self.decoder.place, end) != payload.level_ends[passed]:
                    payload.fields.refuse("levels", "a level ends at another byte than said")
                passed += 1
            if passed == keep:
                break

    def level(self, vertices, known):
        p, k, old = self.payload, 3, 0
        step = p.step * (max(power(known, p.taper), 0.1) if known > 0 else 0.1)
        near = {v: [[0.0, u] for u in self.order.candidates[v]] for v in vertices}
        while vertices and k < p.K:
            s = max(1, k * p.growth // 8 + k * k // 64)
            last = k + s if k + s + s // 4 < p.K else p.K
            weights = self.weights(vertices, near, (old, k))
            for v, w in zip(vertices, weights):
                neighbours = [u for _, u in near[v][:p.neighbours]]
                for c, guess in zip(range(k, last), self.guesses(v, w, neighbours, (k, last))):
                    self.value(v, c, neighbours, (guess, step))
            old, k = k, last
        for v in vertices if self.lengths else []:
            self.lengths.know(v, self.C[v])

    def guesses(self, v, w, neighbours, batch):
        k, last = batch
        rows = [self.C[u].tolist() for u in neighbours]
        guessed = [dot(w, [row[c] for row in rows]) for c in range(k, self.payload.K if self.lengths else last)]
        more = self.lengths and self.lengths.corrections(self.C[v, :k].tolist() + guessed, neighbours, k)
        return [a + b for a, b in zip(guessed, more)] if more else guessed

    def weights(self, vertices, near, batch):
        (old, known), C = batch, self.C
        for v in vertices:
            for one in near[v]:
                sums = [0.0] * 4
                d = (C[one[1], old:known] - C[v, old:known]).tolist()
                for i, x in enumerate(d):
                    sums[i % 4] += x * x
                one[0] += (sums[0] + sums[1]) + (sums[2] + sums[3])
            near[v].sort()
        n = min(self.payload.neighbours, len(near[vertices[0]]))
        if n == 0:
            return [[]] * len(vertices)
        chosen = numpy.array([[u for _, u in near[v][:n]] for v in vertices])
        e = C[chosen, :known] - C[vertices, None, :known]
        e = numpy.array(self.relevance[:known]) * e
        p = self.payload
        return kriging(e.transpose(0, 2, 1), p.linear, p.squared_bend, (0.01, 2.0 * p.step))

    def value(self, v, k, neighbours, guessed):
        (guess, step), seen = guessed, self.seen
        n, o, u = self.nearby([seen[g][k] for g in neighbours]), self.own[v], self.usual[k]
        e = 0.45 * n + 0.3 * o + 0.25 * u
        before = [seen[v][k - 1], seen[v][k - 2]] + [seen[g][k] for g in neighbours[:3]]
        context = 0
        for size in before + [0] * (5 - len(before)):
            context = 3 * context + min(size, 2)
        places = (18 * octave_column(1, n, 22) + octave_column(1, o, 18),
                  14 * min(k, 95) + octave_column(0, e, 14), context)
        level = self.levels.level(places, octave_column(0, e, 12))
        self.C[v, k] = bounded(guess + level * step)
        size = magnitude(level)
        seen[v][k] = min(size, 255)
        self.own[v] += 0.3 * (size - self.own[v])
        self.usual[k] += 0.01 * (size - self.usual[k])


def basis_of(Y, payload):
    """(mean [3F], B [K][3F], energies [K])"""
    K, unit = payload.K, 1.0 / sqrt(float(payload.W))
    energies, B = [], []
    for k in range(1, K + 1):
        energies.append(dot(*[[x for row in Y for x in row[3 * k:3 * k + 3]]] * 2))
        scale = 1.0 / sqrt(energies[-1]) if energies[-1] > 0 else 0.0
        B.append([scale * row[3 * k + axis] for axis in range(3) for row in Y])
    return [payload.origin[axis] + unit * row[axis] for axis in range(3) for row in Y], B, energies


def open_payload(fields, topology, frames, keep=None, relaxed=True):
    """(mean [3F], B [K][3F], C [W][K]) of a payload. keep: how many levels of detail, the coarsest first; None: all."""
    payload = Payload(fields, frames, len(topology.surface.vertices))
    Y = Poses(payload).Y
    first = FirstComponents(payload, topology.surface)
    mean, B, energies = basis_of(Y, payload)
    C = first.C if payload.K <= 3 else AllOthers(payload, first, (mean, B, energies), keep).C
    if relaxed and payload.length_noise and keep is None and payload.K > 0 and frames > 1:
        deviation = payload.step * (payload.length_noise / 256)
        C = Relaxation(topology.surface.triangles, mean, B).relax(C, deviation * deviation)
    return mean, B, C


def order_of(fields, topology, frames):
    """The order in which a payload's levels of detail keep vertices."""
    payload = Payload(fields, frames, len(topology.surface.vertices))
    order = Order(FirstComponents(payload, topology.surface).C, 1)
    if len(order.counts()) != len(payload.level_ends):
        fields.refuse("levels", "another number of levels than its vertices make")
    return order
