"""Which triangles are neighbours, and in which order vertices are met: docs/connectivity.md, "Adjacency" and "Trace".

SPDX-License-Identifier: MIT
"""

from collections import deque

NONE = (1 << 32) - 1


def after(half):
    return half - 2 if half % 3 == 2 else half + 1


def before(half):
    return half + 2 if half % 3 == 0 else half - 1


class Adjacency:
    """Triangles turned to agree with their neighbours; `twin` of half-edge 3t + i, None at a border."""

    def __init__(self, triangles):
        edges, mate = {}, [None] * (3 * len(triangles))
        for t, corners in enumerate(triangles):
            if len(set(corners)) == 3:
                for i in range(3):
                    edges.setdefault(frozenset((corners[i], corners[(i + 1) % 3])), []).append(3 * t + i)
        for halves in edges.values():
            if len(halves) == 2:
                mate[halves[0]], mate[halves[1]] = halves[1], halves[0]
        self.flipped = self.orient(triangles, mate)
        self.triangles = [(a, c, b) if flip else (a, b, c) for (a, b, c), flip in zip(triangles, self.flipped)]
        turned = [self.place(h) for h in range(len(mate))]
        self.twin = [None] * len(mate)
        for h, other in enumerate(mate):
            self.twin[turned[h]] = None if other is None else turned[other]

    @staticmethod
    def orient(triangles, mate):
        flipped = [None] * len(triangles)
        for first in range(len(triangles)):
            if flipped[first] is not None:
                continue
            flipped[first], queue = False, deque([first])
            while queue:
                t = queue.popleft()
                for h in range(3 * t, 3 * t + 3):
                    if mate[h] is None:
                        continue
                    o = mate[h]
                    same = triangles[t][h % 3] == triangles[o // 3][o % 3]
                    if flipped[o // 3] is None:
                        flipped[o // 3] = flipped[t] != same
                        queue.append(o // 3)
                    elif flipped[o // 3] != (flipped[t] != same):
                        mate[h] = mate[o] = None
        return flipped

    def place(self, half):
        """The turned half-edge of an edge of the list."""
        return half - half % 3 + 2 - half % 3 if self.flipped[half // 3] else half

    def given(self, corner):
        """The corner of the list that a turned one is."""
        i = corner % 3
        return corner - i + (3 - i) % 3 if self.flipped[corner // 3] else corner

    def origin(self, half):
        return self.triangles[half // 3][half % 3]


class Trace:
    """The order in which vertices are met.

    vertices: of the list, in that order; number: its inverse; gates: (left, right, opposite), surface numbers or None;
    triangles: in the order visited, in surface numbers; corners: the list's corner of each of their corners.
    """

    def __init__(self, vertex_count, triangles):
        self.mesh = mesh = Adjacency(triangles)
        self.number, self.vertices, self.gates = [None] * vertex_count, [], []
        self.visited, self.corners = [False] * len(triangles), []
        order = []
        for first in range(len(triangles)):
            if self.visited[first]:
                continue
            for i, vertex in enumerate(mesh.triangles[first]):
                known = [self.number[v] for j, v in enumerate(mesh.triangles[first]) if j != i]
                self.meet(vertex, [v for v in known if v is not None])
            self.visited[first] = True
            order.append(first)
            stack = self.across(3 * first + 2, 3 * first + 1, 3 * first)
            while stack:
                g = stack.pop()
                if self.visited[g // 3]:
                    continue
                ends = [mesh.origin(h) for h in (g, after(g), before(mesh.twin[g]))]
                self.meet(mesh.origin(before(g)), [self.number[v] for v in ends])
                self.visited[g // 3] = True
                order.append(g // 3)
                stack += self.across(before(g), after(g))
        for vertex in range(vertex_count):
            self.meet(vertex, [])
        self.corners = [3 * t + i for t in order for i in range(3)]
        self.triangles = [tuple(self.number[v] for v in triangles[t]) for t in order]

    def across(self, *halves):
        twins = [self.mesh.twin[h] for h in halves]
        return [h for h in twins if h is not None and not self.visited[h // 3]]

    def meet(self, vertex, known):
        if self.number[vertex] is None:
            self.number[vertex] = len(self.vertices)
            self.vertices.append(vertex)
            self.gates.append(tuple(known[:3]) + (None,) * (3 - len(known)))
