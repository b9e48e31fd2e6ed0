"""zstd and xz: on float32 as they are, and on positions on a grid, as differences from frame to frame, in byte planes."""
# SPDX-License-Identifier: MIT
import os
import struct

import numpy

from . import files, stages
from .peer import Peer, PeerError, Run, Stopwatch

PACKERS = {"zstd": (stages.zstd_pack, stages.zstd_unpack), "xz": (stages.xz_pack, stages.xz_unpack)}
SOURCES = {"zstd": "Debian libzstd1 (zstd --version)", "xz": "liblzma, through Python's lzma (xz --version)"}


def encode_raw(packer, clip, folder):
    watch, path = Stopwatch(), os.path.join(folder, "clip.bin")
    positions, triangles = numpy.asarray(clip.positions), clip.triangles.astype("<u4")
    with watch.running():
        parts = [PACKERS[packer][0](array.tobytes()) for array in (positions, triangles)]
    files.pack(path, [struct.pack("<2I", clip.V, clip.F), *parts])
    return Run([path], watch.seconds)


def decode_raw(packer, paths, folder):
    watch = Stopwatch()
    head, *parts = files.unpack(paths[0])
    V, F = struct.unpack("<2I", head)
    with watch.running():
        positions, triangles = (PACKERS[packer][1](part) for part in parts)
    if len(positions) != 12 * V * F:
        raise PeerError(f"{len(positions)} bytes are not {F} frames of {V} vertices")
    positions = numpy.frombuffer(positions, dtype="<f4").reshape(F, V, 3)
    return Run(files.give_back(folder, positions, numpy.frombuffer(triangles, dtype="<u4").reshape(-1, 3)), watch.seconds)


def differences(levels):
    """From frame to frame, and of those from vertex to vertex; axis by axis, frame by frame: [3 x F x V]."""
    motion = numpy.diff(levels.transpose(2, 0, 1), axis=1, prepend=0)
    return numpy.diff(motion, axis=2, prepend=0)


def levels_from(deltas):
    motion = numpy.cumsum(deltas, axis=2, dtype=numpy.int32)
    return numpy.cumsum(motion, axis=1, dtype=numpy.int32).transpose(1, 2, 0)


def encode_deltas(packer, clip, setting, folder):
    watch, path = Stopwatch(), os.path.join(folder, "clip.bin")
    pack, positions = PACKERS[packer][0], numpy.asarray(clip.positions)
    with watch.running():
        grid = stages.Grid.around(positions, setting["bits"])
        motion = pack(stages.planes(stages.folded(differences(grid.levels(positions)))))
        triangles = pack(stages.triangle_planes(clip.triangles))
    files.pack(path, [struct.pack("<3I", clip.V, clip.F, clip.T) + grid.bytes(), motion, triangles])
    return Run([path], watch.seconds)


def decode_deltas(packer, paths, folder):
    watch, unpack = Stopwatch(), PACKERS[packer][1]
    head, motion, triangles = files.unpack(paths[0])
    V, F, T = struct.unpack_from("<3I", head)
    with watch.running():
        deltas = stages.unfolded(stages.from_planes(unpack(motion), 3 * F * V)).reshape(3, F, V)
        positions = stages.Grid.from_bytes(head[12:]).values(levels_from(deltas))
        triangles = stages.triangles_from_planes(unpack(triangles), T)
    return Run(files.give_back(folder, positions, triangles), watch.seconds)


def raw_peer(packer, title):
    return Peer(
        name=f"{packer}-raw", title=f"{title}, float32", source=SOURCES[packer], lossless=True, ladder=({},),
        counts="float32 positions and 32-bit triangles, each packed as it lies in memory",
        missing=lambda: stages.missing_library("zstd", "libzstd1") if packer == "zstd" else "",
        encode=lambda clip, setting, folder: encode_raw(packer, clip, folder),
        decode=lambda paths, folder: decode_raw(packer, paths, folder))


def delta_peer(packer, title):
    return Peer(
        name=f"{packer}-deltas", title=f"{title}, quantised deltas", source=SOURCES[packer],
        counts="differences of quantised positions and of vertex numbers of triangles, in byte planes, packed; the grid",
        ladder=tuple({"bits": bits} for bits in (6, 7, 8, 9, 10, 12, 14, 16)), promise=stages.Grid.promise,
        missing=lambda: stages.missing_library("zstd", "libzstd1") if packer == "zstd" else "",
        encode=lambda clip, setting, folder: encode_deltas(packer, clip, setting, folder),
        decode=lambda paths, folder: decode_deltas(packer, paths, folder))


PEERS = tuple(make(packer, title) for make in (raw_peer, delta_peer) for packer, title in (("zstd", "zstd -19"), ("xz", "xz -9e")))
