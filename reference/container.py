"""A .reel file: chunks, and what the container's own hold; docs/format.md, sections 1 to 4 and 7.

SPDX-License-Identifier: MIT
"""

import ctypes
import ctypes.util
import math
import struct
from types import SimpleNamespace

import attributes
import connectivity
from coding import Damaged, unfold, varint

MOST_VERTICES, MOST_TRIANGLES, MOST_FRAMES, MOST_MEMORY = 10**8, 2 * 10**8, 10**6, 16 << 30
SIGNATURE = bytes.fromhex("8d5245454c0d0a0a")
ONCE = ("HEAD", "TIME", "meta", "CONN", "matl", "grup", "INDX", "TAIL")


def library(name, function, result, *arguments):
    """A function of a shared library."""
    found = getattr(ctypes.CDLL(ctypes.util.find_library(name)), function)
    found.restype, found.argtypes = result, arguments
    return found


xxh3 = library("xxhash", "XXH3_64bits", ctypes.c_uint64, ctypes.c_char_p, ctypes.c_size_t)
zstd_size = library("zstd", "ZSTD_getFrameContentSize", ctypes.c_uint64, ctypes.c_char_p, ctypes.c_size_t)
zstd_frame = library("zstd", "ZSTD_findFrameCompressedSize", ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t)
zstd_unpack = library("zstd", "ZSTD_decompress", ctypes.c_size_t,
                      ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t)


def hash_of(data):
    return xxh3(bytes(data), len(data))


class Fields:
    """Reads a payload field by field."""

    def __init__(self, data, at, name, memory=None):
        self.data, self.at, self.name, self.place = data, at, name, 0
        self.memory = memory or [MOST_MEMORY]

    def refuse(self, field, sentence, place=None):
        raise Damaged(self.at + (self.place if place is None else place), f"{self.name}.{field}", sentence)

    def take(self, count, field):
        if count > len(self.data) - self.place:
            self.refuse(field, "the payload ends before it does")
        self.place += count
        return self.data[self.place - count:self.place]

    def varint(self, field, low=0, high=(1 << 64) - 1):
        start = self.place
        value, self.place = varint(self.data, start, self.at, f"{self.name}.{field}")
        if not low <= value <= high:
            self.refuse(field, f"{value} is not within {low} .. {high}", start)
        return value

    def u8(self, field, high, low=0):
        value = self.take(1, field)[0]
        if not low <= value <= high:
            self.refuse(field, f"{value} is not within {low} .. {high}", self.place - 1)
        return value

    def number(self, field, form="d", low=-math.inf, high=math.inf):
        value = struct.unpack("<" + form, self.take(struct.calcsize(form), field))[0]
        if not (math.isfinite(value) and low <= value <= high):
            self.refuse(field, f"{value} is not allowed", self.place - struct.calcsize(form))
        return value

    def bytes(self, field):
        return self.take(self.varint(field), field)

    def text(self, field, most=65535):
        return self.take(self.varint(field, 0, most), field)

    def squeezed(self, field):
        """Bytes, or the zstd frame that stands for them."""
        if self.u8(field + ".method", 1) == 0:
            return self.bytes(field + ".data")
        size = self.varint(field + ".size", 0, MOST_MEMORY)
        data = self.bytes(field + ".data")
        self.memory[0] -= size
        if size > (len(data) // 4 + 1) * (128 << 10) or self.memory[0] < 0:
            self.refuse(field + ".size", "more bytes than the frame can hold or the memory limit allows")
        if zstd_size(data, len(data)) != size or zstd_frame(data, len(data)) != len(data):
            self.refuse(field + ".data", "not one zstd frame of the size given")
        unpacked = ctypes.create_string_buffer(max(size, 1))
        if zstd_unpack(unpacked, size, data, len(data)) != size:
            self.refuse(field + ".data", "a damaged zstd frame")
        return unpacked.raw[:size]

    def rest(self):
        return self.take(len(self.data) - self.place, "rest")

    def done(self):
        if self.place != len(self.data):
            self.refuse("size", "the payload is longer than its fields")


def chunks(data):
    """[(type, offset, payload's offset, payload)] of a whole file, all checked."""
    if data[:8] != SIGNATURE or len(data) < 16:
        raise Damaged(0, "preamble.signature", "this is no .reel file")
    major, _, checksum = struct.unpack("<HHI", data[8:16])
    if checksum != hash_of(data[:12]) & 0xFFFFFFFF:
        raise Damaged(12, "preamble.checksum", "the preamble is damaged")
    if major != 1:
        raise Damaged(8, "preamble.major", f"version {major} is not known")
    found, place = [], 16
    while not found or found[-1][0] != "TAIL":
        start, kind = place, data[place:place + 4]
        if len(kind) < 4 or not kind.isalpha():
            raise Damaged(start, "type", "no chunk begins here")
        kind = kind.decode("ascii")
        size, place = varint(data, place + 4, 0, kind + ".size")
        if size + 4 > len(data) - place:
            raise Damaged(start + 4, kind + ".size", "the chunk is longer than the file")
        payload, place = data[place:place + size], place + size + 4
        if struct.unpack("<I", data[place - 4:place])[0] != hash_of(data[start:place - 4]) & 0xFFFFFFFF:
            raise Damaged(place - 4, kind + ".checksum", "the chunk is damaged")
        found.append((kind, start, place - 4 - size, payload))
    if place != len(data):
        raise Damaged(place, "TAIL", "bytes follow the end of the file")
    return found


def check_places(found, size):
    """INDX says exactly what is there, and TAIL where; chunks are as many, and where, as they must be."""
    names = [kind for kind, *_ in found]
    for kind, start, *_ in found:
        if kind not in ONCE + ("attr", "aset", "SEGM") and kind[0].isupper():
            raise Damaged(start, kind, "a chunk that must be understood and is not known")
        if kind in ONCE and names.count(kind) > 1:
            raise Damaged(start, kind, "more than one of it")
    missing = {"HEAD", "TIME", "CONN", "SEGM", "INDX", "TAIL"} - set(names)
    if missing or names[0] != "HEAD" or names[-2] != "INDX":
        raise Damaged(16, "file", "a chunk is missing or not in its place")
    index = Fields(found[-2][3], found[-2][2], "INDX")
    listed = []
    for i in range(index.varint("chunks", 0, len(found))):
        kind = index.take(4, f"chunks[{i}].type").decode("latin1")
        listed.append((kind, index.varint(f"chunks[{i}].offset"), index.varint(f"chunks[{i}].size")))
    index.done()
    if listed != [(kind, start, len(payload)) for kind, start, _, payload in found[:-2]]:
        index.refuse("chunks", "the index says something else than the file", 0)
    if len(found[-1][3]) != 16 or struct.unpack("<QQ", found[-1][3]) != (found[-2][1], size):
        raise Damaged(found[-1][2], "TAIL", "it does not say where the index is and how long the file")


def read_head(fields):
    head = SimpleNamespace(codec=fields.text("codec", 32).decode("latin1"))
    head.V = fields.varint("vertex_count", 1, MOST_VERTICES)
    head.W = fields.varint("coded_vertex_count", 1, head.V)
    head.T = fields.varint("triangle_count", 0, MOST_TRIANGLES)
    head.F = fields.varint("frame_count", 1, MOST_FRAMES)
    head.order = fields.u8("order", 2)
    head.base = struct.unpack("<Q", fields.take(8, "base_fingerprint"))[0] if head.order == 2 else None
    fields.text("encoder", 256)
    fields.done()
    if 12 * head.T + 12 * head.F * head.V > MOST_MEMORY:
        fields.refuse("frame_count", "more than the memory limit allows", 0)
    return head


def rank_of(number):
    """Of neighbouring doubles the ranks differ by 1."""
    bits = struct.unpack("<Q", struct.pack("<d", number))[0]
    return bits ^ (1 << 64) - 1 if bits >> 63 else bits | 1 << 63


def double_of(rank):
    bits = rank ^ (1 << 63) if rank >> 63 else rank ^ (1 << 64) - 1
    return struct.unpack("<d", struct.pack("<Q", bits))[0]


def read_times(fields, frames):
    mode, start = fields.u8("mode", 1), fields.number("start_s")
    fps = fields.number("fps", low=math.ulp(0.0))
    times = [start + f / fps for f in range(frames)]
    if mode == 1:
        data = fields.squeezed("corrections")
        if len(data) != 8 * frames:
            fields.refuse("corrections", "not eight bytes a frame")
        for f, t in enumerate(times):
            correction = unfold(sum(data[b * frames + f] << 8 * b for b in range(8)))
            times[f] = double_of((rank_of(t) + correction) % (1 << 64))
    fields.done()
    if not all(map(math.isfinite, times)) or any(a >= b for a, b in zip(times, times[1:])):
        fields.refuse("fps", "times are not finite or do not increase", 0)
    return times


def read_meta(fields):
    meta = {"name": fields.text("name"), "loop": fields.u8("loop", 1), "up": fields.u8("up", 3),
            "metres_per_unit": fields.number("metres_per_unit", low=0.0), "fps": fields.number("fps", low=0.0)}
    fields.done()
    return meta


def read_names(fields):
    names = [fields.text(f"names[{i}].text") for i in range(fields.varint("names", 0, len(fields.data)))]
    fields.done()
    return names


def read_asset(fields):
    asset = {"name": fields.text("name"), "mime_type": fields.text("mime_type", 255), "data": fields.squeezed("bytes")}
    fields.done()
    return asset


def read(data, base=None):
    """Everything in a file but its frames, which stay payloads: .segments is [(first, count, payload, offset)].

    @param base (V, triangles) of the base mesh, for files that need one
    """
    found = chunks(data)
    check_places(found, len(data))
    memory = [MOST_MEMORY]
    parts = {}
    for kind, _, at, payload in found:
        parts.setdefault(kind, []).append(Fields(payload, at, kind, memory))
    file = read_head(parts["HEAD"][0])
    file.times = read_times(parts["TIME"][0], file.F)
    file.meta = read_meta(parts["meta"][0]) if "meta" in parts else {}
    if file.order == 2:
        flat = [v for t in base[1] for v in t] if base else []
        if base is None or hash_of(struct.pack(f"<{len(flat) + 1}I", base[0], *flat)) != file.base:
            parts["HEAD"][0].refuse("base_fingerprint", "the base mesh is missing or another one")
    conn = parts["CONN"][0]
    file.topology = top = connectivity.decode(conn.data, conn.at, base and base[1])
    if (top.vertex_count, len(top.triangles), len(top.surface.vertices)) != (file.V, file.T, file.W):
        conn.refuse("vertex_count", "other counts than in HEAD")
    file.materials, file.groups = ([n for part in parts.get(k, []) for n in read_names(part)] for k in ("matl", "grup"))
    file.attributes = [attributes.read(part, file) for part in parts.get("attr", [])]
    file.assets = [read_asset(part) for part in parts.get("aset", [])]
    file.segments = []
    for part in parts["SEGM"]:
        expected = sum(count for _, count, *_ in file.segments)
        part.varint("first_frame", expected, expected)
        count = part.varint("frame_count", 1, file.F - expected)
        at = part.at + part.place
        file.segments.append((expected, count, part.rest(), at))
    if sum(count for _, count, *_ in file.segments) != file.F:
        parts["SEGM"][-1].refuse("frame_count", "the segments do not cover all frames", 0)
    return file
