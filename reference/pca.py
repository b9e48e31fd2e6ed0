"""Codecs that extrapolate or average principal components: coddyac, na, lsp, rbfp.

Pages: src/meshreel/codecs/coddyac.md, average.md, lsp.md, rbfp.md.
SPDX-License-Identifier: MIT
"""

import struct
from math import floor, sqrt

import numpy

from coding import HuffmanSymbols, RangeSymbols
from decimation import Decimation

COLUMNS = 1, 2, 3, 5, 8, 12, 20, 36, 80
RAW, COBRA, LPC = 0, 2, 3


def magnitude(level):
    return min(abs(level), 65535)


class Contexts:
    """Opens bits and numbers the contexts of levels: one column by Huffman, ten by the range coder."""

    def __init__(self, fields, field, rows, ranged):
        self.data = fields.bytes(field)
        self.at, self.field = fields.at + fields.place - len(self.data), f"{fields.name}.{field}"
        self.columns, self.rows, self.ranged = 10 if ranged else 1, rows, ranged

    def open(self, alphabets):
        if self.ranged:
            return RangeSymbols(self.data, alphabets, self.at, self.field)
        return HuffmanSymbols(self.data, self.rows * self.columns, alphabets, self.at, self.field)

    def of(self, row, nearby):
        return row * self.columns + (sum(nearby >= first for first in COLUMNS) if self.ranged else 0)


def power(base, exponent):
    fixed, result, square = floor(exponent * 65536 + 0.5), 1.0, base
    whole = fixed >> 16
    while whole:
        if whole & 1:
            result *= square
        square *= square
        whole >>= 1
    for bit in range(15, -1, -1):
        base = sqrt(base)
        if fixed >> bit & 1:
            result *= base
    return result


def motion(v, order):
    """The next value after v, predicted from its last ones."""
    if order == 0:
        return 0.0
    if order == 1:
        return v[-1]
    if order == 2:
        return 2 * v[-1] - v[-2]
    if order == 3:
        return 3 * v[-1] - 3 * v[-2] + v[-3]
    return 4 * v[-1] - 6 * v[-2] + 4 * v[-3] - v[-4]


class BasisReader:
    """The mean and the basis."""

    def __init__(self, contexts, law, frames):
        self.contexts, self.law, self.frames = contexts, law, frames
        self.coder, self.order, self.weights = contexts.open([4]), 0, None

    def read(self, bases):
        coding, mean_step, k, q, a = self.law
        rows = []
        for i in range(bases + 1):
            step = mean_step if i == 0 else k * power(float(i), q) + a
            if coding == COBRA:
                self.order = 1 + self.coder.symbol(0)
            elif coding >= LPC and i <= 1:
                self.order = coding - LPC + 1
                self.weights = [self.weight() * (2.0**-16 if j else step) for j in range(self.order + 1)]
            rows.append(self.trajectory(step, 0 if i == 0 else 3))
        return rows

    def weight(self):
        stored = self.coder.raw(20)
        return stored - (1 << 20) if stored >> 19 else stored

    def trajectory(self, step, row):
        values, levels = [], [0] * self.frames
        for axis in range(3):
            series = []
            for f in range(self.frames):
                nearby = 2 * magnitude(levels[f - 1] if f > 0 else 0) + magnitude(levels[f - 2] if f > 1 else 0)
                nearby += 2 * magnitude(levels[f])
                levels[f] = self.coder.level(self.contexts.of(row + axis, nearby))
                series.append(self.guess(series) + levels[f] * step)
            values += series
        return values

    def guess(self, series):
        if len(series) < self.order:
            return motion(series, len(series))
        if self.weights is None:
            return motion(series, self.order)
        guess = self.weights[0]
        for j in range(1, self.order + 1):
            guess += self.weights[j] * series[-j]
        return guess


class Residuals:
    """Coefficients of all vertices, from the coarsest mesh on."""

    def __init__(self, contexts, coder, bases, step):
        self.contexts, self.coder, self.K, self.step = contexts, coder, bases, step
        self.C, self.levels = [], []

    def extrapolate(self, gates):
        """The parallelogram along the gates of a trace."""
        for v, (left, right, opposite) in enumerate(gates):
            around = [self.levels[g] for g in (left, right, opposite) if g is not None]
            guess = self.parallelogram(v, left, right, opposite)
            own, levels, row = 0, [], []
            for k in range(self.K):
                nearby = sum(magnitude(other[k]) for other in around) + own
                levels.append(self.coder.level(self.contexts.of(k, nearby)))
                row.append(guess[k] + levels[k] * self.step)
                own = (own + 2 * magnitude(levels[k])) // 2
            self.C.append(row)
            self.levels.append(levels)

    def parallelogram(self, v, left, right, opposite):
        C = self.C
        if opposite is not None:
            return [a + b - c for a, b, c in zip(C[left], C[right], C[opposite])]
        if right is not None:
            return [0.5 * (a + b) for a, b in zip(C[left], C[right])]
        return C[left] if left is not None else C[v - 1] if v > 0 else [0.0] * self.K

    def refine(self, rings, predictor):
        """Rows below the coarsest mesh, each predicted from its neighbours, the smallest component first."""
        for ring in rings:
            predict = predictor(len(ring), self.step)
            own, levels, row = 0, [0] * self.K, [0.0] * self.K
            for k in range(self.K - 1, -1, -1):
                y = [self.C[r][k] for r in ring]
                nearby = 3 * sum(magnitude(self.levels[r][k]) for r in ring) // len(ring) + own
                levels[k] = self.coder.level(self.contexts.of(self.K + k, nearby))
                row[k] = predict.guess(y) + levels[k] * self.step
                predict.learn(y, row[k])
                own = (own + 2 * magnitude(levels[k])) // 2
            self.C.append(row)
            self.levels.append(levels)


def added(values):
    total = 0.0
    for value in values:
        total += value
    return total


class Average:
    def __init__(self, n, step):
        self.n, self.step = n, step

    def guess(self, y):
        return added(y) / self.n

    def learn(self, y, value):
        pass


def solve(A, b):
    """L D L^T without pivoting; of A the lower half, both overwritten."""
    n, dependent = len(b), []
    for i in range(n):
        whole, g = A[i][i], []
        for j in range(i):
            total = A[i][j]
            for k in range(j):
                total -= g[k] * A[j][k]
            g.append(total)
            A[i][j] = 0.0 if dependent[j] else total / A[j][j]
        for k in range(i):
            A[i][i] -= g[k] * A[i][k]
        dependent.append(not A[i][i] > 1e-12 * whole)
    for i in range(n):
        for k in range(i):
            b[i] -= A[i][k] * b[k]
    for i in range(n):
        b[i] = 0.0 if dependent[i] else b[i] / A[i][i]
    for i in range(n - 1, -1, -1):
        if not dependent[i]:
            for k in range(i + 1, n):
                b[i] -= A[k][i] * b[k]
    return b


class LeastSquares(Average):
    def __init__(self, n, step):
        super().__init__(n, step)
        self.gram, self.right = [[0.0] * n for _ in range(n)], [0.0] * n
        self.known, self.seen = 0, [()] * n

    def guess(self, y):
        kept = [i for i, values in enumerate(self.seen) if self.seen.index(values) == i]
        if self.known < len(kept):
            return added(y) / self.n
        ridge = self.step * self.step
        A = [[self.gram[i][j] for j in kept[:row + 1]] for row, i in enumerate(kept)]
        for i, row in enumerate(A):
            row[i] += ridge
        w = solve(A, [self.right[i] + ridge / len(kept) for i in kept])
        return added(weight * y[i] for weight, i in zip(w, kept))

    def learn(self, y, value):
        for i in range(self.n):
            for j in range(i + 1):
                self.gram[i][j] += y[i] * y[j]
            self.right[i] += y[i] * value
        self.known += 1
        self.seen = [values + (x,) for values, x in zip(self.seen, y)]


def radial(s):
    return s / sqrt(sqrt(sqrt(s))) if s > 0 else 0.0


class RadialBasis(Average):
    def __init__(self, n, step):
        super().__init__(n, step)
        self.apart, self.away = [[0.0] * n for _ in range(n)], [0.0] * n

    def guess(self, y):
        kept, members = [], []
        for i in range(self.n):
            for place, first in enumerate(kept):
                if self.apart[i][first] <= self.step * self.step:
                    members[place].append(y[i])
                    break
            else:
                kept.append(i)
                members.append([y[i]])
        if len(kept) == 1:
            return added(y) / self.n
        means = [added(values) / len(values) for values in members]
        o, others = kept[0], kept[1:]
        x_o, far = radial(self.away[o]), [radial(self.apart[i][o]) for i in others]
        w = [far[i] + x_o - radial(self.away[p]) for i, p in enumerate(others)]
        A = [[far[i] + far[j] - radial(self.apart[p][others[j]]) for j in range(i)] + [2 * far[i]]
             for i, p in enumerate(others)]
        total = means[0]
        for weight, mean in zip(solve(A, w), means[1:]):
            total += weight * (mean - means[0])
        return total

    def learn(self, y, value):
        for i in range(self.n):
            for j in range(self.n):
                self.apart[i][j] += (y[i] - y[j]) * (y[i] - y[j])
            self.away[i] += (value - y[i]) * (value - y[i])


PREDICTORS = {"na": Average, "lsp": LeastSquares, "rbfp": RadialBasis}


class Runs:
    """Who goes, by how many stay before the next that does."""

    def __init__(self, coder):
        self.coder, self.left = coder, None

    def goes(self, _context):
        if self.left is None:
            self.left = self.coder.symbol(0)
            if self.left > 15:
                below = self.left - 12
                self.left = 1 << below | self.coder.raw(below)
        if self.left > 0:
            self.left -= 1
            return 0
        self.left = None
        return 1


def open_payload(fields, codec, topology, frames):
    """(mean [3F], B [K][3F], C [W][K]) of a payload."""
    W = len(topology.surface.vertices)
    K = fields.varint("bases", 0, 3 * frames)
    if 8 * (K + 1) * (6 * frames + 2 * W) > fields.memory[0]:
        fields.refuse("bases", "the basis and its coefficients do not fit in the memory limit")
    step, ranged = fields.number("step", low=5e-324), fields.u8("entropy", 1)
    coding, law = fields.u8("basis_coding", 6), ()
    if coding != RAW:
        law = (coding, fields.number("mean_step", low=5e-324), fields.number("k", low=0.0),
               fields.number("q", low=0.0, high=16.0), fields.number("a"))
        if law[2] + law[4] <= 0:
            fields.refuse("a", "the first step k + a is not above 0")
    if coding == RAW:
        data = fields.bytes("basis_bits")
        if len(data) != 12 * frames * (K + 1):
            fields.refuse("basis_bits", "does not hold a float32 for each value")
        values = [float(x) for x in struct.unpack(f"<{len(data) // 4}f", data)]
        rows = [values[i:i + 3 * frames] for i in range(0, len(values), 3 * frames)]
    else:
        rows = BasisReader(Contexts(fields, "basis_bits", 6, ranged), law, frames).read(K)
    contexts = Contexts(fields, "residual_bits", 2 * K if codec in PREDICTORS else K, ranged)
    fields.done()
    return rows[0], rows[1:], coefficients(codec, contexts, topology.surface, (K, step))


def coefficients(codec, contexts, surface, sizes):
    if codec == "coddyac":
        residuals = Residuals(contexts, contexts.open([]), *sizes)
        residuals.extrapolate(surface.gates)
        return residuals.C
    coder = contexts.open([2] * 72 if contexts.ranged else [43])
    levels = coder.raw(5)
    decimation = Decimation(surface, levels, coder.symbol if contexts.ranged else Runs(coder).goes)
    residuals = Residuals(contexts, coder, *sizes)
    residuals.extrapolate(decimation.gates)
    residuals.refine(decimation.rings, PREDICTORS[codec])
    C = [None] * len(residuals.C)
    for vertex, row in zip(decimation.vertices, residuals.C):
        C[vertex] = row
    return C


def frames_of(mean, B, C):
    """Positions [F, W, 3] in float64: (8.2), one product added after the other."""
    posed = numpy.tile(numpy.array(mean)[:, None], len(C))
    for row, of_vertices in zip(B, numpy.array(C).T):
        posed = posed + numpy.array(row)[:, None] * of_vertices
    return posed.reshape(3, -1, len(C)).transpose(1, 2, 0)
