"""Bjontegaard-delta rate: how much more or less one curve needs than another, over the errors that both reach.

As VCEG-M33: the mean difference of the logarithms of two rates, as functions of quality in dB, over the qualities that both
curves have. Between the points stands a piecewise cubic (PCHIP, Fritsch and Carlson 1980), as JVET and AOM have it, instead of
M33's one cubic through four points: it never overshoots. Its integral is exact.
"""
# SPDX-License-Identifier: MIT
import math
from bisect import bisect_right

LEAST = 3  # points of a curve


class NoDelta(Exception):
    """Two curves that cannot be compared; the sentence says why."""


def quality(error):
    """An error as quality in dB; a percentage, a ratio, whatever is 0 for equal animations: a unit only shifts the axis."""
    return -20 * math.log10(error)


def frontier(points):
    """Quality and log10 rate of (rate, error), rising: without the points that another beats in both, and without lossless ones."""
    best = []
    for rate, error in sorted(points):
        if error > 0 and (not best or quality(error) > best[-1][0] + 1e-9):
            best.append((quality(error), math.log10(rate)))
    return best


def edge_slope(h0, h1, d0, d1):
    """The slope at an end: that of the parabola through three points, kept from overshooting."""
    slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
    if slope * d0 <= 0:
        return 0.0
    return 3 * d0 if d0 * d1 <= 0 and abs(slope) > 3 * abs(d0) else slope


def slopes_of(x, y):
    """The slopes of the PCHIP at its points: the weighted harmonic mean of those on both sides, 0 where they disagree."""
    h = [b - a for a, b in zip(x, x[1:])]
    d = [(b - a) / step for a, b, step in zip(y, y[1:], h)]
    if len(d) == 1:
        return [d[0], d[0]]
    inner = [0.0 if d[i] * d[i + 1] <= 0 else
             3 * (h[i] + h[i + 1]) / ((2 * h[i + 1] + h[i]) / d[i] + (h[i + 1] + 2 * h[i]) / d[i + 1]) for i in range(len(d) - 1)]
    return [edge_slope(h[0], h[1], d[0], d[1]), *inner, edge_slope(h[-1], h[-2], d[-1], d[-2])]


def piece_integral(ends, slopes, upto):
    """The integral of one cubic (Hermite) from its first end to `upto`, a share 0 .. 1 of its length."""
    (x0, y0), (x1, y1) = ends
    h, t = x1 - x0, upto
    m0, m1 = (h * slope for slope in slopes)
    c2, c3 = 3 * (y1 - y0) - 2 * m0 - m1, 2 * (y0 - y1) + m0 + m1
    return h * t * (y0 + t * (m0 / 2 + t * (c2 / 3 + t * c3 / 4)))


def integral(points, low, high):
    """The integral of the PCHIP through the points from low to high."""
    x, y = zip(*points)
    slopes = slopes_of(x, y)

    def until(end):
        last = min(max(bisect_right(x, end) - 1, 0), len(x) - 2)
        whole = sum(piece_integral(points[i:i + 2], slopes[i:i + 2], 1.0) for i in range(last))
        return whole + piece_integral(points[last:last + 2], slopes[last:last + 2], (end - x[last]) / (x[last + 1] - x[last]))

    return until(high) - until(low)


def bd_rate(anchor, other):
    """Percent of rate that `other` needs more than `anchor` at the same error, and what share of the anchor's qualities was compared.

    Both: (rate, error) in any order. Raises NoDelta where there is nothing to compare."""
    curves = [frontier(points) for points in (anchor, other)]
    for name, curve in zip(("the anchor's", "its own"), curves):
        if len(curve) < LEAST:
            raise NoDelta(f"{len(curve)} usable points on {name} curve, at least {LEAST} are needed")
    low, high = max(curve[0][0] for curve in curves), min(curve[-1][0] for curve in curves)
    if low >= high:
        ranges = [f"{10 ** (-curve[-1][0] / 20):.3g} .. {10 ** (-curve[0][0] / 20):.3g}" for curve in curves]
        raise NoDelta(f"the curves do not overlap: the anchor's errors are {ranges[0]}, its own {ranges[1]}")
    before, after = (integral(curve, low, high) for curve in curves)
    return 100 * (10 ** ((after - before) / (high - low)) - 1), (high - low) / (curves[0][-1][0] - curves[0][0][0])
