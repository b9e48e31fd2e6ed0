"""The payload of CONN: docs/connectivity.md.

SPDX-License-Identifier: MIT
"""

from bisect import bisect_left
from dataclasses import dataclass

from coding import Damaged, Models, RangeDecoder, varint
from reordered import Tries, read_order
from surface import NONE, Trace

WRAP = NONE


@dataclass
class Topology:
    """What codecs and files see of the triangles.

    vertex_count: V; triangles: of the file; surface_of: the surface vertex of each of the file's; surface: a Trace
    """

    vertex_count: int
    triangles: list
    surface_of: list
    surface: Trace


class Reader(RangeDecoder):
    """The range coded part of the payload, with the models of what stands once in it."""

    def refuse(self, field, sentence):
        raise Damaged(self.at + min(self.place, len(self.data)), field, sentence)

    def any(self):
        return self.decide(Models()[0])


def decode(data, at, base=None, closed_limit=1 << 28):
    """@param base triangles of the base mesh, where the order is 2."""
    kind, place = varint(data, 0, at, "topology_kind")
    vertices, place = varint(data, place, at, "vertex_count")
    triangles, place = varint(data, place, at, "triangle_count")
    order, method = kind & 3, kind >> 2
    if (order, method) not in ((0, 2), (0, 3), (1, 1), (1, 2), (2, 0)):
        raise Damaged(at, "topology_kind", f"{kind} is no kind of topology")
    if vertices > 10**8 or triangles > (1 << 32) // 12 - 2:
        raise Damaged(at, "vertex_count", "more vertices or triangles than a reader allows")
    reader = Reader(data[place:], at + place, "CONN")
    if order == 1:
        return decode_free(reader, method, vertices, triangles, closed_limit)
    classes = read_classes(reader, vertices)
    count = max(classes, default=-1) + 1
    if order == 2:
        if base is None or len(base) != triangles or any(v >= vertices for t in base for v in t):
            raise Damaged(at, "base", "the base mesh is missing or another one")
        trace = Trace(count, [tuple(classes[v] for v in t) for t in base])
        return Topology(vertices, base, [trace.number[c] for c in classes], trace)
    given = read_list(reader, method, count, triangles, closed_limit)
    trace = Trace(count, given)
    surface_of = [trace.number[c] for c in classes]
    copies = [[] for _ in range(count)]
    for vertex, s in enumerate(surface_of):
        copies[s].append(vertex)
    corners = [None] * (3 * triangles)
    for corner, vertex in zip(trace.corners, read_corners(reader, trace, copies)):
        corners[corner] = vertex
    return Topology(vertices, [tuple(corners[i:i + 3]) for i in range(0, len(corners), 3)], surface_of, trace)


def decode_free(reader, method, vertices, triangles, closed_limit):
    repeats = reader.number(Models(), "repeats")
    if repeats > vertices:
        reader.refuse("repeats", "more repeated vertices than vertices")
    trace = Trace(vertices - repeats, read_list(reader, method, vertices - repeats, triangles, closed_limit))
    any_copies, models, total, before, copies = reader.any(), Models(), 0, 0, []
    for _ in range(vertices - repeats):
        others = reader.number(models, before) if any_copies else 0
        copies.append(range(total, total + others + 1))
        total, before = total + others + 1, int(others > 0)
        if total > vertices:
            reader.refuse("copy_counts", "more copies than vertices")
    if total != vertices:
        reader.refuse("copy_counts", "fewer copies than vertices")
    corners = read_corners(reader, trace, copies)
    surface_of = [s for s, own in enumerate(copies) for _ in own]
    return Topology(vertices, [tuple(corners[i:i + 3]) for i in range(0, len(corners), 3)], surface_of, trace)


def read_classes(reader, vertices):
    if not reader.any():
        return list(range(vertices))
    models, history, met, last, classes = Models(), 0, 0, 0, []
    for _ in range(vertices):
        repeats = reader.decide(models[history])
        history = (history << 1 | repeats) & 7
        if repeats:
            last = last + 1 + reader.jump(models, "jump")
            if not 0 <= last < met:
                reader.refuse("classes", "a vertex repeats one that is not yet met")
            classes.append(last)
        else:
            classes.append(met)
            met += 1
    return classes


def read_corners(reader, trace, copies):
    """The vertex at each surface corner."""
    if all(len(own) == 1 for own in copies):
        return [copies[s][0] for t in trace.triangles for s in t]
    models, last, used, missed, found = Models(), {}, {}, 0, []
    for s in (s for t in trace.triangles for s in t):
        count = len(copies[s])
        if count == 1:
            found.append(copies[s][0])
            continue
        so_far = used.get(s, 0)
        state = 0 if so_far == 0 else 1 if so_far < count else 2
        if so_far and reader.decide(models["same", state, missed]):
            missed = 0
        else:
            missed, place = 1, so_far
            if so_far == count or not reader.decide(models["fresh", state]):
                place = reader.raw((count - 1).bit_length())
            if place >= count:
                reader.refuse("corner_copies", "a copy that is not there")
            used[s], last[s] = max(so_far, place + 1), place
        found.append(copies[s][last[s]])
    return found


def read_list(reader, method, vertices, triangles, closed_limit):
    if method == 2:
        return read_sequence(reader, vertices, triangles)
    shell = read_shell(reader, vertices, triangles, closed_limit)
    return shell if method == 1 else read_order(reader, vertices, shell)


def read_shell(reader, vertices, triangles, closed_limit):
    models = Models()
    closed = triangles + reader.number(models, "closed")
    if closed > min(4 * triangles, closed_limit):
        reader.refuse("closed_triangle_count", "more triangles than a closed mesh can have")
    merges, symbol = {}, -1
    for _ in range(reader.number(models, "count")):
        symbol += 1 + reader.number(models, "gap")
        merges[symbol] = [reader.number(models, field) for field in ("depth", "position", "length")]
        if symbol >= closed:
            reader.refuse("merges", "a merge beyond the string")
    components = read_symbols(reader, models, closed, merges)
    budget = [64 * closed + 1024]
    string = [(measure(reader, component, merges, budget), component) for component in components]
    copies = read_copies(reader, sum(3 + [s for _, s in c].count("C") for c in components))
    if len(copies) - copies.count(None) and max((c for c in copies if c is not None), default=-1) >= vertices:
        reader.refuse("copies", "more vertices than announced")
    border = Border(reader, budget)
    for splits, component in string:
        border.component(component, splits, merges)
    named = [tuple(copies[c] for c in t) for t in border.triangles]
    named = [t for t in named if None not in t]
    if len(named) != triangles:
        reader.refuse("copies", "another number of triangles than announced")
    if reader.any():
        history, models = 0, Models()
        for i, (a, b, c) in enumerate(named):
            flip = reader.decide(models[history])
            history = (history << 1 | flip) & 15
            named[i] = (a, c, b) if flip else (a, b, c)
    return named


def read_symbols(reader, models, closed, merges):
    """For each component its symbols, each with its place in the string."""
    components, left, place = [], closed, 0
    one, two, run = "C", "C", 0
    while left > 0:
        left, open_borders, symbols = left - 1, 1, []
        while open_borders > 0:
            if left == 0:
                reader.refuse("clers", "the string ends before its last border does")
            symbol = "S"
            for guess in "CRLE":
                if reader.decide(models[one, two, run, guess]):
                    symbol = guess
                    break
            if place in merges and (symbol != "S" or open_borders < 2):
                reader.refuse("clers", "a merge where none can be")
            if symbol == "S":
                open_borders += -1 if place in merges else 1
            open_borders -= symbol == "E"
            symbols.append((place, symbol))
            run = min(run + 1, 7) if symbol in "CL" else 0
            one, two, left, place = symbol, one, left - 1, place + 1
        components.append(symbols)
    if merges and max(merges) >= place:
        reader.refuse("merges", "a merge beyond the string")
    return components


def spend(reader, budget, steps):
    budget[0] -= steps
    if budget[0] < 0:
        reader.refuse("clers", "the string takes too many steps")


def measure(reader, symbols, merges, budget):
    """{place: (right, left)} of every S that is no merge."""
    lengths, splits = [], {}
    for place, symbol in reversed(symbols):
        wrong = not lengths and symbol != "E"
        if symbol == "E":
            lengths.append(3)
        elif not wrong and symbol in "CRL":
            lengths[-1] += -1 if symbol == "C" else 1
            wrong = lengths[-1] < 2
        elif not wrong and place in merges:
            depth, position, length = merges[place]
            wrong = length < 2 or position >= length or lengths[-1] < length + 3 or depth >= len(lengths)
            if not wrong:
                spend(reader, budget, depth)
                lengths[-1] -= length + 1
                lengths.insert(len(lengths) - 1 - depth, length)
        elif not wrong:
            wrong = len(lengths) < 2
            if not wrong:
                splits[place] = right, left = lengths.pop(), lengths.pop()
                lengths.append(right + left - 1)
        if wrong:
            reader.refuse("clers", "the borders' lengths do not come out")
    if lengths != [3]:
        reader.refuse("clers", "the borders' lengths do not come out")
    return splits


def read_copies(reader, count):
    """The vertex of each copy; None is a dummy."""
    any_dummy, any_glued = reader.any(), reader.any()
    models, kind, fresh, glued, copies = Models(), 0, 0, 0, []
    for _ in range(count):
        if any_dummy and reader.decide(models["dummy", kind]):
            kind = 1
            copies.append(None)
        elif any_glued and reader.decide(models["glued", kind]):
            kind, glued = 2, glued + reader.jump(models, "jump")
            if not 0 <= glued < fresh:
                reader.refuse("copies", "glued to a vertex that is not yet met")
            copies.append(glued)
        else:
            kind, fresh = 0, fresh + 1
            copies.append(fresh - 1)
    return copies


class Border:
    """Triangles of copies, as symbols make them: docs/connectivity.md, "Borders"."""

    def __init__(self, reader, budget):
        self.reader, self.budget = reader, budget
        self.triangles, self.next, self.previous, self.copies = [], {}, {}, 0

    def link(self, left, right):
        self.next[left], self.previous[right] = right, left

    def left_end(self, edge):
        return self.triangles[edge // 3][(edge + 1) % 3]

    def right_end(self, edge):
        return self.triangles[edge // 3][edge % 3]

    def walk(self, edge, right, left):
        spend(self.reader, self.budget, min(right, left))
        way = self.next if right <= left else self.previous
        for _ in range(min(right, left)):
            edge = way[edge]
        return edge

    def component(self, symbols, splits, merges):
        k = 3 * len(self.triangles)
        self.triangles.append((self.copies, self.copies + 1, self.copies + 2))
        self.copies += 3
        for left, right in ((k, k + 2), (k + 2, k + 1), (k + 1, k)):
            self.link(left, right)
        gate, stack = k + 1, []
        for place, symbol in symbols:
            gate = self.step(gate, stack, symbol, (place, splits, merges))

    def step(self, gate, stack, symbol, string):
        k = 3 * len(self.triangles)
        right, left, x = self.next[gate], self.previous[gate], None
        place, splits, merges = string
        if symbol == "S" and place in merges:
            depth, position, length = merges[place]
            spend(self.reader, self.budget, depth)
            x = self.walk(stack.pop(len(stack) - 1 - depth), position, length - position)
        elif symbol == "S":
            x = self.walk(gate, splits[place][0], splits[place][1] - 1)
            stack.append(k + 2)
        tip = (self.copies if symbol == "C" else self.left_end(left) if symbol == "L"
               else self.left_end(x) if symbol == "S" else self.right_end(right))
        self.copies += symbol == "C"
        self.triangles.append((self.left_end(gate), self.right_end(gate), tip))
        if symbol == "E":
            return stack.pop() if stack else None
        if symbol == "C":
            links = (left, k + 2), (k + 1, right), (k + 2, k + 1)
        elif symbol == "R":
            links = (left, k + 2), (k + 2, self.next[right])
        elif symbol == "L":
            links = (k + 1, right), (self.previous[left], k + 1)
        else:
            links = (k + 1, right), (left, k + 2), (self.previous[x], k + 1), (k + 2, x)
        for link in links:
            self.link(*link)
        return k + 2 if symbol == "R" else k + 1


def read_sequence(reader, vertices, count):
    unused, used, tries, models = list(range(vertices)), set(), Tries(reader), Models()
    out, into, new = {}, {}, NONE
    triangles, kinds = [(0, 0, 0)] * 4, [(0, 0, 0)] * 2
    for _ in range(count):
        y, z, u = triangles[-1], triangles[-2], triangles[-4]
        x, h0, h1, h2 = [], [], kinds[-1], kinds[-2]
        for j in range(3):
            raw = sequence_candidates(j, (x, y, z, u), (unused[0] if unused else NONE, new), (out, into))
            possible = [None if c is None or c & NONE >= vertices or c & NONE in x else c & NONE for c in raw]
            t = (32 * h1[2] + h1[1], 32 * (h0 or [0])[0] + h1[2], 32 * h0[1] + h0[0] if j == 2 else 0)[j]

            def contexts(value, alike, near):
                f = 8 * alike + 2 * near + (value in used)
                return (h1[j], 32 * h1[j] + h2[j], t, f, (32 * t + h1[j]) * 32 + h2[j], (32 * t + h2[j]) * 1024 + f)

            kind, vertex = tries.right((j, h1[j]), possible, contexts, 32 * j)
            if vertex is None:
                vertex = far_vertex(reader, models, (j, x, y, new), (vertices, unused))
            if vertex not in used:
                used.add(vertex)
                del unused[bisect_left(unused, vertex)]
                new = vertex
            x.append(vertex)
            h0.append(kind)
        for a, b in ((x[0], x[1]), (x[1], x[2]), (x[2], x[0])):
            if out.get(b) == a or into.get(a) == b:
                if out.get(b) == a:
                    del out[b]
                if into.get(a) == b:
                    del into[a]
            else:
                out[a], into[b] = b, a
        triangles.append(tuple(x))
        kinds.append(tuple(h0))
    return triangles[4:]


def sequence_candidates(j, rows, numbers, edges):
    (x, y, z, u), (lowest, new), (out, into) = rows, numbers, edges
    first = [lowest, new + 1, new - 1]
    if j == 0:
        return first + [2 * y[0] - z[0], 2 * z[0] - u[0], y[0] + 1, y[0] - 1, *y, *z,
                        out.get(y[0]), into.get(y[0]), z[0] + 1, z[0] - 1]
    last = x[j - 1]
    steps = [last + 1, last - 1] if j == 1 else [x[0] + y[2] - y[0], x[0] + z[2] - z[0]]
    return first + [last + y[j] - y[j - 1], last + z[j] - z[j - 1], *steps, *y, *z,
                    into.get(last), out.get(last), into.get(x[0]), out.get(x[0])]


def far_vertex(reader, models, state, numbers):
    """A vertex that is no candidate."""
    (j, x, y, new), (vertices, unused) = state, numbers
    if reader.decide(models["unused", j]):
        near = min(vertices, (new + 1) & WRAP if j == 0 else x[-1])
        rank = bisect_left(unused, near) + reader.jump(models, ("rank", j))
        if 0 <= rank < len(unused):
            return unused[rank]
    else:
        vertex = (x[-1] if j else y[0]) + reader.jump(models, ("jump", j))
        if 0 <= vertex < vertices:
            return vertex
    return reader.refuse("sequence", "a vertex beyond the last")
