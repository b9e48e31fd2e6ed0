"""Levels of detail: docs/format.md, section 5, and src/meshreel/codecs/reel.md.

SPDX-License-Identifier: MIT
"""

from heapq import heappop, heappush
from math import sqrt


def kept_of(order, level):
    """Surface vertices that a level keeps."""
    return order.order[:order.counts()[::-1][level]]


def coarse_triangles(triangles, X, kept):
    """Triangles between the kept vertices, by place in `kept`, which rises in the file's order.

    triangles: in surface numbers; X [W, 3]
    """
    beside = [set() for _ in X]
    for t in triangles:
        for v in t:
            beside[v].update(t)
    sources = set(kept)
    best, waiting = [(float("inf"), len(kept))] * len(X), []

    def offer(distance, cell, v):
        if (distance, cell) < best[v]:
            best[v] = distance, cell
            heappush(waiting, (distance, cell, v))

    for cell, v in enumerate(kept):
        offer(0.0, cell, v)
    while waiting:
        distance, cell, v = heappop(waiting)
        if best[v] < (distance, cell):
            continue
        for u in beside[v] - sources:
            x, y, z = (float(a) - float(b) for a, b in zip(X[v], X[u]))
            offer(distance + sqrt(x * x + y * y + z * z), cell, u)
    found, seen = [], set()
    for t in triangles:
        cells = tuple(best[v][1] for v in t)
        i = cells.index(min(cells))
        turned = cells[i:] + cells[:i]
        if len(set(cells)) == 3 and len(kept) not in cells and turned not in seen:
            seen.add(turned)
            found.append(cells)
    return found
