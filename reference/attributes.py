"""Tables of values on the mesh: docs/format.md, section 4.

SPDX-License-Identifier: MIT
"""

import struct
from types import SimpleNamespace

from coding import unfold

NONE = (1 << 32) - 1
WIDTHS = 4, 1, 2, 4, 1, 2
TYPES = "f32", "u8", "u16", "u32", "i8", "i16"
DOMAINS = "vertex", "corner", "triangle"


def read_table(fields, name):
    table = SimpleNamespace(name=name, mapping=fields.u8(name + ".mapping", 2), scale=0.0)
    if table.mapping == 2:
        table.scale = fields.number(name + ".scale", low=1.0, high=float(1 << 40))
    table.prediction = fields.u8(name + ".prediction", 4)
    table.planes = fields.u8(name + ".planes", 1)
    table.data = fields.squeezed(name + ".bytes")
    return table


def read(fields, file):
    """One attribute; its words are as wide as its type and stand value by value in `values`."""
    a = SimpleNamespace(name=fields.text("name"), domain=fields.u8("domain", 2), type=fields.u8("type", 5))
    a.components, a.normalized = fields.u8("components", 16, 1), fields.u8("normalized", 1)
    a.count = fields.varint("value_count", 0, 16 << 30)
    repeated, stored, places = fields.u8("repeated", 1), a.count, None
    if repeated:
        stored = fields.varint("distinct_count", 0, 16 << 30)
        places = read_table(fields, "places")
    values = read_table(fields, "values")
    indices = read_table(fields, "indices") if fields.u8("indexed", 1) else None
    fields.done()
    elements = (file.V, 3 * file.T, file.T)[a.domain]
    unpack = Unpacker(fields, file, a.domain)
    unpack.indices = unpack.words(indices, elements, 4) if indices else None
    if unpack.indices is None and a.count != elements:
        fields.refuse("value_count", "not as many values as elements", 0)
    if any(i >= a.count and i != NONE for i in unpack.indices or []):
        fields.refuse("indices", "an index beyond the values", 0)
    if repeated:
        unpack.places = unpack.words(places, a.count, 4)
        if any(p >= stored for p in unpack.places):
            fields.refuse("places", "a place beyond the values", 0)
    if values.mapping and a.type != 0:
        fields.refuse("values.mapping", "only for f32", 0)
    words = unpack.words(values, stored, WIDTHS[a.type], a.components)
    rows = [words[i:i + a.components] for i in range(0, len(words), a.components)]
    a.values = [rows[p] for p in unpack.places] if repeated else rows
    a.indices = unpack.indices
    if a.name in (b"material", b"group"):
        names = len(file.materials if a.name == b"material" else file.groups)
        if (a.domain, a.type, a.components) != (2, 3, 1) or any(names <= row[0] != NONE for row in a.values):
            fields.refuse("values", "not the number of a name for each triangle", 0)
    return a


class Unpacker:
    """Tables of one attribute, in the four steps of the page."""

    def __init__(self, fields, file, domain):
        self.fields, self.triangles, self.domain = fields, file.topology.triangles, domain
        self.indices = self.places = None

    def words(self, table, count, width, components=1):
        if len(table.data) != count * width * components:
            self.fields.refuse(table.name + ".bytes", "not as many bytes as words need", 0)
        self.mask, self.components = (1 << 8 * width) - 1, components
        residuals = self.laid_out(table, count, width)
        self.check(table, width)
        predict = (self.none, self.previous, self.mesh, self.corner, self.fresh)[table.prediction]
        words = [w & self.mask for w in predict(residuals)]
        return [self.mapped(table, w) for w in words] if table.mapping else words

    def check(self, table, width):
        corner = table.prediction == 3 and not (table.name == "indices" and self.domain == 1)
        mesh = table.prediction == 2 and not (table.name == "values" and self.domain != 2)
        fresh = table.prediction == 4 and (width != 4 or self.components != 1)
        if corner or mesh or fresh:
            self.fields.refuse(table.name + ".prediction", "not for this table", 0)

    def laid_out(self, table, count, width):
        words = count * self.components
        if not table.planes:
            return [int.from_bytes(table.data[i:i + width], "little") for i in range(0, words * width, width)]
        return [sum(table.data[(c * width + b) * count + i] << 8 * b for b in range(width))
                for i in range(count) for c in range(self.components)]

    @staticmethod
    def mapped(table, word):
        if table.mapping == 1:
            return word & 0x7FFFFFFF if word >> 31 else word ^ NONE
        n = word - (1 << 32) if word >> 31 else word
        bits = struct.unpack("<I", struct.pack("<f", (n if n >= 0 else -1 - n) / table.scale))[0]
        return bits if n >= 0 else bits ^ 1 << 31

    @staticmethod
    def none(residuals):
        return residuals

    def previous(self, residuals):
        words = []
        for i, r in enumerate(residuals):
            words.append((words[i - self.components] if i >= self.components else 0) + unfold(r) & self.mask)
        return words

    @staticmethod
    def fresh(residuals):
        words, high = [], 0
        for r in residuals:
            word = high - r & NONE
            words.append(word)
            if word != NONE:
                high = max(high, word + 1)
        return words

    def entry(self, corner):
        """The entry that a corner of a face names, or None."""
        e = self.triangles[corner // 3][corner % 3] if self.domain == 0 else corner
        if self.indices is not None:
            e = self.indices[e]
        return None if e == NONE else self.places[e] if self.places is not None else e

    def mesh(self, residuals):
        n, count = self.components, len(residuals) // self.components
        met, third, last, order = {}, {}, None, iter(range(count))

        def meet(e, guess):
            i = next(order) * n
            met[e] = [g + unfold(r) & self.mask for g, r in zip(guess, residuals[i:i + n])]
            return e

        for t in range(len(self.triangles)):
            face = [self.entry(3 * t + i) for i in range(3)]
            for i, e in enumerate(face):
                a, b = face[(i + 1) % 3], face[(i + 2) % 3]
                edge = frozenset((a, b))
                if None not in face and e not in met:
                    o = third.get(edge)
                    if a in met and b in met and o in met:
                        guess = [x + y - z for x, y, z in zip(met[a], met[b], met[o])]
                    else:
                        guess = met.get(a) or met.get(b) or met.get(last) or [0] * n
                    last = meet(e, guess)
                third[edge] = e
        for e in range(count):
            if e not in met:
                last = meet(e, met.get(last) or [0] * n)
        return [word for e in range(count) for word in met[e]]

    def corner(self, residuals):
        latest, own, high, indices = {}, {}, 0, []
        for t, corners in enumerate(self.triangles):
            mates = []
            for i in range(3):
                ends = corners[(i + 1) % 3], corners[(i + 2) % 3]
                mates.append(latest.get(frozenset(ends)))
                latest[frozenset(ends)] = 3 * t + i
            for i, v in enumerate(corners):
                expected = own.get(v, 0)
                for mate in (mates[(i + 2) % 3], mates[(i + 1) % 3]):
                    if mate is not None and mate // 3 != t:
                        there = [c for c in range(mate - mate % 3, mate - mate % 3 + 3)
                                 if self.triangles[c // 3][c % 3] == v and c != mate]
                        expected = indices[there[0]] if there else expected
                r = residuals[3 * t + i]
                before = indices[-1] if indices else 0
                index = (expected if r == 0 else high if r == 1 else before + unfold(r - 2)) & NONE
                own[v] = index
                high = max(high, index + 1) if index != NONE else high
                indices.append(index)
        return indices
