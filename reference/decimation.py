"""Vertices taken away level by level, and who was beside them: src/meshreel/codecs/average.md.

SPDX-License-Identifier: MIT
"""

from surface import Adjacency, Trace

MOST = 24


class Mesh:
    """The mesh at the beginning of a level."""

    def __init__(self, vertices, triangles):
        self.triangles, self.star = triangles, [[] for _ in range(vertices)]
        self.beside, self.edges, self.stuck = [set() for _ in range(vertices)], {}, set()
        for corners in triangles:
            for v in set(corners):
                self.star[v].append(corners)
            if len(set(corners)) < 3:
                self.stuck.update(corners)
                continue
            for a, b in zip(corners, corners[1:] + corners[:1]):
                self.edges[frozenset((a, b))] = self.edges.get(frozenset((a, b)), 0) + 1
                self.beside[a].add(b)
                self.beside[b].add(a)

    def count(self, a, b):
        return self.edges.get(frozenset((a, b)), 0)

    def ring(self, v):
        """(neighbours in turn, whether they make a ring), or None."""
        star = self.star[v]
        if not 1 <= len(star) <= MOST or v in self.stuck:
            return None
        following = {}
        for t in star:
            i = t.index(v)
            following[t[(i + 1) % 3]] = t[(i + 2) % 3]
        starts = set(following) - set(following.values())
        closed = not starts
        ring = [min(following) if closed else next(iter(starts))]
        while ring[-1] in following and len(ring) <= len(star):
            ring.append(following[ring[-1]])
        if closed and ring[-1] != ring[0]:
            return None
        ring = ring[:-1] if closed else ring
        whole = len(following) == len(star) and len(starts) < 2 and len(set(ring)) == len(ring)
        if not whole or len(ring) != len(star) + (not closed) or len(ring) > MOST or (closed and len(ring) < 3):
            return None
        return ring, closed

    def hole(self, v):
        """(ring, triangles that close it, edges claimed), or None where v stays."""
        found = self.ring(v)
        if found is None:
            return None
        ring, closed = found
        if len(ring) > 3 or (len(ring) == 3 and not closed):
            return self.cut_ears(ring, closed)
        sides = list(zip(ring, ring[1:] + ring[:1]))[:len(ring) if closed else 1]
        if any(self.count(a, b) != 2 for a, b in sides):
            return None
        if closed and any(v not in t and set(t) == set(ring) for t in self.star[ring[0]]):
            return None
        return ring, [tuple(ring)] if closed else [], [frozenset(sorted(ring)[:2])]

    def cut_ears(self, ring, closed):
        degree = {r: len(self.beside[r]) - 1 for r in ring}
        corners, triangles, claims = list(ring), [], []

        def make(a, b):
            claims.append(frozenset((a, b)))
            degree[a] += 1
            degree[b] += 1

        if not closed:
            if self.count(ring[0], ring[-1]):
                return None
            make(ring[0], ring[-1])
        while len(corners) > 3:
            tips = []
            for i, tip in enumerate(corners):
                left, right = corners[i - 1], corners[(i + 1) % len(corners)]
                if not self.count(left, right):
                    tips.append((degree[left] + degree[right] - degree[tip], tip, left, right))
            if not tips:
                return None
            _, tip, left, right = min(tips)
            make(left, right)
            triangles.append((left, tip, right))
            corners.remove(tip)
        return ring, triangles + [tuple(corners)], claims


class Decimation:
    """Rows are vertices of the coarsest mesh by its trace, then those of the levels, the last level first."""

    def __init__(self, surface, levels, goes):
        """@param surface triangles in surface numbers; goes(context) asks whether a vertex goes"""
        vertices = len(surface.vertices)
        mesh, gone, live = Mesh(vertices, Adjacency(surface.triangles).triangles), [], set(range(vertices))
        for level in range(1, levels + 1):
            gone.append(self.take_level(mesh, level, live, goes))
            triangles = [t for t in mesh.triangles if live.issuperset(t)]
            mesh = Mesh(vertices, triangles + [t for *_, patch in gone[-1] for t in patch])
        rest = sorted(live)
        number = {v: i for i, v in enumerate(rest)}
        trace = Trace(len(rest), [tuple(number[v] for v in t) for t in mesh.triangles])
        self.gates, self.vertices, self.rings = trace.gates, [rest[v] for v in trace.vertices], []
        for level in reversed(gone):
            self.vertices += [v for v, *_ in level]
            self.rings += [ring for _, ring, _ in level]
        row = {v: i for i, v in enumerate(self.vertices)}
        self.rings = [[row[v] for v in ring] for ring in self.rings]

    @staticmethod
    def take_level(mesh, level, live, goes):
        gone, locked, claimed = [], set(), set()
        for v in sorted(live):
            hole = None if v in locked else mesh.hole(v)
            if hole is None or not claimed.isdisjoint(hole[2]):
                continue
            ring, triangles, claims = hole
            settled = len(locked.intersection(ring))
            context = 24 * min(level - 1, 2) + 4 * (min(max(len(ring), 3), 8) - 3) + min(settled, 3)
            if goes(context):
                live.remove(v)
                locked.update(ring)
                claimed.update(claims)
                gone.append((v, ring, triangles))
        return gone
