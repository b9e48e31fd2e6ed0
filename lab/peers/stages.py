"""Stages that several peers share: zstd and xz in this process, a uniform grid, signs folded, bytes in planes."""
# SPDX-License-Identifier: MIT
import ctypes
import ctypes.util
import lzma
from functools import cache

import numpy

from .peer import PeerError


@cache
def library(name):
    """A shared library of Debian's, or nothing."""
    path = ctypes.util.find_library(name)
    return ctypes.CDLL(path) if path else None


def missing_library(name, package):
    return "" if library(name) else f"lib{name} is not installed (Debian's {package})"


@cache
def zstd():
    lib = library("zstd")
    for function in (lib.ZSTD_compress, lib.ZSTD_decompress, lib.ZSTD_compressBound, lib.ZSTD_getFrameContentSize):
        function.restype = ctypes.c_ulonglong if function is lib.ZSTD_getFrameContentSize else ctypes.c_size_t
    lib.ZSTD_compressBound.argtypes = [ctypes.c_size_t]
    lib.ZSTD_compress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t, ctypes.c_int]
    lib.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    lib.ZSTD_getFrameContentSize.argtypes = [ctypes.c_char_p, ctypes.c_size_t]
    return lib


def zstd_pack(raw, level=19):
    room = zstd().ZSTD_compressBound(len(raw))
    packed = ctypes.create_string_buffer(room)
    size = zstd().ZSTD_compress(packed, room, raw, len(raw), level)
    if zstd().ZSTD_isError(ctypes.c_size_t(size)):
        raise PeerError("zstd cannot pack")
    return packed.raw[:size]


def zstd_unpack(packed):
    size = zstd().ZSTD_getFrameContentSize(packed, len(packed))
    if size >= 1 << 62:  # its two error codes
        raise PeerError("no zstd frame of known size")
    raw = ctypes.create_string_buffer(max(size, 1))
    if zstd().ZSTD_decompress(raw, size, packed, len(packed)) != size:
        raise PeerError("zstd cannot unpack")
    return raw.raw[:size]


def xz_pack(raw):
    return lzma.compress(raw, preset=9 | lzma.PRESET_EXTREME)


xz_unpack = lzma.decompress


class Grid:
    """A uniform grid over the box of all frames: 2^bits - 1 steps along its longest side, the same step for every axis.
    Bits need not be whole."""

    def __init__(self, origin, step):
        self.origin, self.step = numpy.asarray(origin, dtype=numpy.float64), float(step)

    @staticmethod
    def around(positions, bits):
        flat = positions.reshape(-1, 3)
        low, high = flat.min(axis=0).astype(numpy.float64), flat.max(axis=0).astype(numpy.float64)
        return Grid(low, max(float((high - low).max()), 1e-30) / (2**bits - 1))

    @staticmethod
    def promise(clip, setting):
        """Half a step, and what float32 cannot hold."""
        positions = numpy.asarray(clip.positions)
        return Grid.around(positions, setting["bits"]).step / 2 + 2**-23 * float(numpy.abs(positions).max())

    def levels(self, positions):
        return numpy.rint((positions - self.origin) / self.step).astype(numpy.int32)

    def values(self, levels):
        return (levels * self.step + self.origin).astype(numpy.float32)

    def bytes(self):
        return numpy.append(self.origin, self.step).astype("<f8").tobytes()

    @staticmethod
    def from_bytes(raw):
        numbers = numpy.frombuffer(raw, dtype="<f8")
        return Grid(numbers[:3], numbers[3])


def folded(values):
    """Signs into the lowest bit: small magnitudes become small numbers."""
    values = values.astype(numpy.int32)
    return ((values << 1) ^ (values >> 31)).astype(numpy.uint32)


def unfolded(numbers):
    return (numbers >> 1).astype(numpy.int32) ^ -(numbers & 1).astype(numpy.int32)


def planes(numbers):
    """uint32 as bytes, all lowest bytes first; as many planes as the largest needs."""
    count = max(1, (int(numbers.max(initial=0)).bit_length() + 7) // 8)
    return numpy.ascontiguousarray(numbers.reshape(-1).astype("<u4").view(numpy.uint8).reshape(-1, 4)[:, :count].T).tobytes()


def from_planes(raw, count):
    """The first of as many numbers as are expected."""
    if count == 0 or len(raw) % count or not 1 <= len(raw) // count <= 4:
        raise PeerError(f"{len(raw)} bytes are not planes of {count} numbers")
    wide = numpy.zeros((count, 4), dtype=numpy.uint8)
    wide[:, :len(raw) // count] = numpy.frombuffer(raw, dtype=numpy.uint8).reshape(-1, count).T
    return wide.view("<u4").reshape(-1)


def triangle_planes(triangles):
    """Vertex numbers as differences, within a triangle and from triangle to triangle, in byte planes."""
    deltas = numpy.diff(triangles, axis=1, prepend=0)
    deltas[:, 0] = numpy.diff(triangles[:, 0], prepend=0)
    return planes(folded(deltas))


def triangles_from_planes(raw, count):
    deltas = unfolded(from_planes(raw, 3 * count)).reshape(count, 3)
    deltas[:, 0] = numpy.cumsum(deltas[:, 0])
    return numpy.cumsum(deltas, axis=1)
