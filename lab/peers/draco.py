"""Draco: all frames as attributes of one mesh, whose connectivity is coded once; positions as they are, or as differences."""
# SPDX-License-Identifier: MIT
import os

import numpy

from . import exchange, files, stages
from .peer import Peer, Run, Stopwatch

PROGRAM = "meshreel-peer-draco"


def encode(deltas, clip, setting, folder):
    watch, path, grid_path = Stopwatch(), os.path.join(folder, "clip.drc"), os.path.join(folder, "grid.bin")
    positions = numpy.asarray(clip.positions)
    with watch.running():
        grid = stages.Grid.around(positions, setting["bits"])
        levels = grid.levels(positions)
        levels = numpy.diff(levels, axis=0, prepend=0) if deltas else levels
    files.pack(grid_path, [grid.bytes()])
    seconds = exchange.feed([exchange.built(PROGRAM), "encode"], path, clip.triangles, levels)
    return Run([path, grid_path], watch.seconds + seconds)


def decode(deltas, paths, folder):
    watch = Stopwatch()
    grid = stages.Grid.from_bytes(files.unpack(paths[1])[0])
    triangles, levels, seconds = exchange.fetch([exchange.built(PROGRAM), "decode"], paths[0])
    with watch.running():
        positions = grid.values(numpy.cumsum(levels, axis=0, dtype=numpy.int32) if deltas else levels)
    return Run(files.give_back(folder, positions, triangles), watch.seconds + seconds)


def peer(name, title, deltas, what):
    return Peer(
        name=name, title=title, source="Debian libdraco-dev (dpkg -s libdraco-dev)",
        missing=lambda: exchange.missing_program(PROGRAM),
        counts=f"one .drc file: Edgebreaker's connectivity once, {what} quantised together as integer attributes, every vertex's "
               "number (Draco orders vertices anew); the grid",
        ladder=tuple({"bits": bits} for bits in (8, 9, 10, 12, 14, 16)), promise=stages.Grid.promise,
        encode=lambda clip, setting, folder: encode(deltas, clip, setting, folder),
        decode=lambda paths, folder: decode(deltas, paths, folder))


PEERS = (peer("draco-frames", "Draco, frames as attributes", False, "all frames"),
         peer("draco-deltas", "Draco, deltas as attributes", True, "the first frame and the differences of frames"))
