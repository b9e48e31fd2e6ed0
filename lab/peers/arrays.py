"""zfp and fpzip: coders of floating-point arrays, given the positions in every layout that makes sense, the smallest kept."""
# SPDX-License-Identifier: MIT
import ctypes
import os
import struct
from collections import Counter

import numpy

from . import files, stages
from .peer import Peer, PeerError, Run, Stopwatch

POINTER, SIZE, INT = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int
ZFP_FLOAT, ZFP_FULL_HEADER = 3, 7


def declare(lib, functions):
    for name, (result, *arguments) in functions.items():
        getattr(lib, name).restype = result
        getattr(lib, name).argtypes = arguments
    return lib


def zfp():
    fields = {f"zfp_field_{n}d": (POINTER, POINTER, INT, *[SIZE] * n) for n in (1, 2, 3, 4)}
    return declare(stages.library("zfp"), {
        **fields, "stream_open": (POINTER, POINTER, SIZE), "stream_close": (None, POINTER),
        "zfp_stream_open": (POINTER, POINTER), "zfp_stream_close": (None, POINTER), "zfp_field_free": (None, POINTER),
        "zfp_stream_set_accuracy": (ctypes.c_double, POINTER, ctypes.c_double), "zfp_stream_set_reversible": (None, POINTER),
        "zfp_stream_maximum_size": (SIZE, POINTER, POINTER), "zfp_stream_set_bit_stream": (None, POINTER, POINTER),
        "zfp_write_header": (SIZE, POINTER, POINTER, ctypes.c_uint), "zfp_read_header": (SIZE, POINTER, POINTER, ctypes.c_uint),
        "zfp_compress": (SIZE, POINTER, POINTER), "zfp_decompress": (SIZE, POINTER, POINTER)})


class ZfpCall:
    """A stream on a field, with the buffer that it writes to or reads from; freed at the end of a with."""

    def __init__(self, array, packed=None, tolerance=None):
        self.lib, self.array = zfp(), array
        self.field = getattr(self.lib, f"zfp_field_{array.ndim}d")(array.ctypes.data, ZFP_FLOAT, *reversed(array.shape))
        self.stream = self.lib.zfp_stream_open(None)
        if tolerance:
            self.lib.zfp_stream_set_accuracy(self.stream, tolerance)
        else:
            self.lib.zfp_stream_set_reversible(self.stream)
        room = len(packed) if packed is not None else self.lib.zfp_stream_maximum_size(self.stream, self.field)
        self.buffer = ctypes.create_string_buffer(packed if packed is not None else b"", room + 8)  # it reads whole words
        self.bits = self.lib.stream_open(self.buffer, room)
        self.lib.zfp_stream_set_bit_stream(self.stream, self.bits)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.lib.zfp_field_free(self.field)
        self.lib.zfp_stream_close(self.stream)
        self.lib.stream_close(self.bits)


def zfp_pack(array, tolerance):
    with ZfpCall(array, tolerance=tolerance) as call:
        written = call.lib.zfp_write_header(call.stream, call.field, ZFP_FULL_HEADER)
        size = call.lib.zfp_compress(call.stream, call.field)
        if not written or not size:
            raise PeerError("zfp cannot pack")
        return call.buffer.raw[:size]


def zfp_unpack(packed, shape):
    array = numpy.empty(shape, dtype=numpy.float32)
    with ZfpCall(array, packed=packed) as call:
        if not call.lib.zfp_read_header(call.stream, call.field, ZFP_FULL_HEADER) \
                or not call.lib.zfp_decompress(call.stream, call.field):
            raise PeerError("zfp cannot unpack")
    return array


class FpzipHead(ctypes.Structure):
    """FPZ of fpzip.h."""
    _fields_ = [(name, INT) for name in ("type", "prec", "nx", "ny", "nz", "nf")]


def fpzip():
    head = ctypes.POINTER(FpzipHead)
    return declare(stages.library("fpzip"), {
        "fpzip_write_to_buffer": (head, POINTER, SIZE), "fpzip_write_header": (INT, head), "fpzip_write": (SIZE, head, POINTER),
        "fpzip_write_close": (None, head), "fpzip_read_from_buffer": (head, POINTER), "fpzip_read_header": (INT, head),
        "fpzip_read": (SIZE, head, POINTER), "fpzip_read_close": (None, head)})


def fpzip_pack(array, precision):
    lib, room = fpzip(), 2 * array.nbytes + 1024
    buffer = ctypes.create_string_buffer(room)
    head = lib.fpzip_write_to_buffer(buffer, room)
    fields = head.contents
    fields.type, fields.prec = 0, precision or 32
    fields.nx, fields.ny, fields.nz, fields.nf = [*reversed(array.shape), 1, 1, 1][:4]
    size = lib.fpzip_write(head, array.ctypes.data) if lib.fpzip_write_header(head) else 0
    lib.fpzip_write_close(head)
    if not size:
        raise PeerError("fpzip cannot pack")
    return buffer.raw[:size]


def fpzip_unpack(packed, shape):
    lib, array = fpzip(), numpy.empty(shape, dtype=numpy.float32)
    head = lib.fpzip_read_from_buffer(packed)
    good = lib.fpzip_read_header(head)
    fields = head.contents
    if good and fields.nx * fields.ny * fields.nz * fields.nf != array.size:
        raise PeerError(f"fpzip holds an array of another size than {array.size}")
    good = good and lib.fpzip_read(head, array.ctypes.data)
    lib.fpzip_read_close(head)
    if not good:
        raise PeerError("fpzip cannot unpack")
    return array


def grid_width(triangles, V):
    """Vertices a row where the mesh is a sheet of rows, numbered along them; 0 where it is not."""
    steps = Counter(numpy.abs(numpy.diff(triangles[:, [0, 1, 2, 0]], axis=1)).reshape(-1).tolist())
    for step, _ in steps.most_common(3):
        if step > 2 and V % step == 0 and set(steps) <= {1, step - 1, step, step + 1}:
            return step
    return 0


# Each: the shapes of the arrays that the positions [F x V x 3] become; three of them are x, y and z.
def layouts(F, V, width):
    known = [[(F, 3 * V)], [(F, V, 3)], [(F, V)] * 3]
    return known + ([[(F, V // width, width, 3)], [(F, V // width, width)] * 3] if width else [])


def split(positions, shapes):
    parts = [positions] if len(shapes) == 1 else [positions[:, :, axis] for axis in range(3)]
    return [numpy.ascontiguousarray(part, dtype=numpy.float32).reshape(shape) for part, shape in zip(parts, shapes)]


def joined(arrays, F, V):
    return arrays[0].reshape(F, V, 3) if len(arrays) == 1 else numpy.stack([array.reshape(F, V) for array in arrays], axis=2)


def encode(pack, clip, folder):
    watch, path = Stopwatch(), os.path.join(folder, "clip.bin")
    positions = numpy.asarray(clip.positions)
    width = grid_width(clip.triangles, clip.V)
    best, seconds = None, 0.0
    for number, shapes in enumerate(layouts(clip.F, clip.V, width)):
        trial = Stopwatch()
        with trial.running():
            parts = [pack(array) for array in split(positions, shapes)]
        if best is None or sum(map(len, parts)) < sum(map(len, best[1])):
            best, seconds = (number, parts), trial.seconds
    with watch.running():
        triangles = stages.zstd_pack(stages.triangle_planes(clip.triangles))
    files.pack(path, [struct.pack("<5I", clip.V, clip.F, clip.T, width, best[0]), triangles, *best[1]])
    return Run([path], seconds + watch.seconds)


def decode(unpack, paths, folder):
    watch = Stopwatch()
    head, triangles, *parts = files.unpack(paths[0])
    V, F, T, width, number = struct.unpack("<5I", head)
    shapes = layouts(F, V, width)[number]
    with watch.running():
        positions = joined([unpack(part, shape) for part, shape in zip(parts, shapes)], F, V)
        triangles = stages.triangles_from_planes(stages.zstd_unpack(triangles), T)
    return Run(files.give_back(folder, positions, triangles), watch.seconds)


def zfp_tolerance(clip, setting):
    return float(numpy.ptp(numpy.asarray(clip.positions).reshape(-1, 3), axis=0).max()) / 2**setting["bits"]


def fpzip_error(clip, setting):
    """Bits beyond sign, exponent and as many of the mantissa are cut off."""
    return float(numpy.abs(numpy.asarray(clip.positions)).max()) * 2.0 ** (9 - setting["precision"])


TRIANGLES = "triangles as differences of vertex numbers in byte planes under zstd -19"
ZFP = {"source": "Debian libzfp1 (zfp; dpkg -s libzfp1)", "missing": lambda: stages.missing_library("zfp", "libzfp1"),
       "decode": lambda paths, folder: decode(zfp_unpack, paths, folder)}
FPZIP = {"source": "Debian libfpzip1 (dpkg -s libfpzip1)", "missing": lambda: stages.missing_library("fpzip", "libfpzip1"),
         "decode": lambda paths, folder: decode(fpzip_unpack, paths, folder)}

PEERS = (
    Peer(name="zfp", title="zfp", ladder=tuple({"bits": bits} for bits in (3, 4, 5, 6, 8, 10, 12, 14)), promise=zfp_tolerance, **ZFP,
         counts=f"zfp's streams at a fixed accuracy, the smallest of 2-D to 4-D layouts; {TRIANGLES}",
         encode=lambda clip, setting, folder: encode(lambda a: zfp_pack(a, zfp_tolerance(clip, setting)), clip, folder)),
    Peer(name="zfp-lossless", title="zfp, reversible", ladder=({},), lossless=True, **ZFP,
         counts=f"zfp's reversible streams, the smallest of 2-D to 4-D layouts; {TRIANGLES}",
         encode=lambda clip, setting, folder: encode(lambda a: zfp_pack(a, None), clip, folder)),
    Peer(name="fpzip", title="fpzip", ladder=tuple({"precision": bits} for bits in (12, 14, 15, 16, 17, 18, 20, 22, 24)), promise=fpzip_error, **FPZIP,
         counts=f"fpzip's streams at so many bits a number, the smallest of 2-D to 4-D layouts; {TRIANGLES}",
         encode=lambda clip, setting, folder: encode(lambda a: fpzip_pack(a, setting["precision"]), clip, folder)),
    Peer(name="fpzip-lossless", title="fpzip, lossless", ladder=({},), lossless=True, **FPZIP,
         counts=f"fpzip's lossless streams, the smallest of 2-D to 4-D layouts; {TRIANGLES}",
         encode=lambda clip, setting, folder: encode(lambda a: fpzip_pack(a, None), clip, folder)),
)
