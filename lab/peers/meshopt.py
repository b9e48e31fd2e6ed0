"""meshoptimizer's vertex codec, version 1, and zstd -19: on differences of quantised frames, and on float32 without loss."""
# SPDX-License-Identifier: MIT
import os
import tempfile

import numpy

from . import exchange, files, stages
from .peer import Peer, Run, Stopwatch

SCRIPT = "meshopt.mjs"


def encode(triangles, levels, width, head, folder):
    """Numbers of F frames, each as the difference to the frame before."""
    watch, path = Stopwatch(), os.path.join(folder, "clip.bin")
    with watch.running():
        deltas = numpy.diff(levels, axis=0, prepend=levels.dtype.type(0))
    with tempfile.NamedTemporaryFile() as packed:
        seconds = exchange.feed(exchange.script(SCRIPT, "encode", width), packed.name, triangles, deltas.view(numpy.int32))
        raw = packed.read()
    with watch.running():
        whole = stages.zstd_pack(raw)
    files.pack(path, [head, whole])
    return Run([path], watch.seconds + seconds)


def decode(width, values, paths, folder):
    """values(head, levels): positions from the sums of differences."""
    watch = Stopwatch()
    head, whole = files.unpack(paths[0])
    with watch.running():
        raw = stages.zstd_unpack(whole)
    with tempfile.NamedTemporaryFile() as packed:
        packed.write(raw)
        packed.flush()
        triangles, deltas, seconds = exchange.fetch(exchange.script(SCRIPT, "decode", width), packed.name, "<u4")
    with watch.running():
        positions = values(head, numpy.cumsum(deltas, axis=0, dtype=numpy.uint32))
    return Run(files.give_back(folder, positions, triangles), watch.seconds + seconds)


def encode_quantised(clip, setting, folder):
    watch = Stopwatch()
    with watch.running():
        grid = stages.Grid.around(numpy.asarray(clip.positions), setting["bits"])
        levels = grid.levels(numpy.asarray(clip.positions)).view(numpy.uint32)
    done = encode(clip.triangles, levels, "16", grid.bytes(), folder)
    return Run(done.files, done.seconds + watch.seconds)


def from_grid(head, levels):
    return stages.Grid.from_bytes(head).values(levels & 0xFFFF)  # differences are counted modulo 2^16


def encode_lossless(clip, setting, folder):
    return encode(clip.triangles, numpy.asarray(clip.positions).view(numpy.uint32), "32", b"", folder)


SAME = {"source": "npm meshoptimizer (lab/peers/package.json), Debian libzstd1", "missing": lambda: exchange.missing_package("meshoptimizer")}
TRIANGLES = ("triangles in its index codec and the original order of vertices in its index sequence codec (both reordered as it "
             "advises); zstd -19 over all of it")

PEERS = (
    Peer(name="meshopt-deltas", title="meshoptimizer + zstd", **SAME, promise=stages.Grid.promise,
         ladder=tuple({"bits": bits} for bits in (6, 7, 8, 9, 10, 12, 14, 16)),
         counts=f"differences of quantised frames in meshoptimizer's vertex codec; {TRIANGLES}; the grid",
         encode=encode_quantised, decode=lambda paths, folder: decode("16", from_grid, paths, folder)),
    Peer(name="meshopt-lossless", title="meshoptimizer + zstd, lossless", **SAME, ladder=({},), lossless=True,
         counts=f"differences of the bits of float32 from frame to frame in meshoptimizer's vertex codec; {TRIANGLES}",
         encode=encode_lossless,
         decode=lambda paths, folder: decode("32", lambda head, bits: bits.view(numpy.float32), paths, folder)),
)
