"""Draco: all frames as attributes of one mesh, whose connectivity is coded once; positions as they are, or as differences."""
# SPDX-License-Identifier: MIT
import os
import subprocess
import tempfile

import numpy

from . import files, stages
from .peer import Peer, PeerError, Run, Stopwatch

HERE = os.path.dirname(os.path.abspath(__file__))


def program():
    return os.path.join(os.environ.get("MESHREEL_BUILD", os.path.join(HERE, "../../build")), "meshreel-peer-draco")


def missing():
    if os.access(program(), os.X_OK):
        return ""
    return "meshreel-peer-draco is not built (tools/install.sh --with-peers, then cmake with -DMESHREEL_BUILD_LAB=ON)"


def run(verb, source, target):
    """The program's own seconds."""
    done = subprocess.run([program(), verb, source, target], capture_output=True, text=True)
    if done.returncode != 0:
        raise PeerError(f"Draco: {done.stderr.strip()}")
    return float(done.stdout)


def encode(deltas, clip, setting, folder):
    watch, path, grid_path = Stopwatch(), os.path.join(folder, "clip.drc"), os.path.join(folder, "grid.bin")
    positions = numpy.asarray(clip.positions)
    with watch.running():
        grid = stages.Grid.around(positions, setting["bits"])
        levels = grid.levels(positions)
        levels = numpy.diff(levels, axis=0, prepend=0) if deltas else levels
    files.pack(grid_path, [grid.bytes()])
    with tempfile.NamedTemporaryFile() as raw:
        for numbers in ((clip.V, clip.F, clip.T), clip.triangles, levels):
            raw.write(numpy.ascontiguousarray(numbers, dtype="<i4").tobytes())
        raw.flush()
        seconds = run("encode", raw.name, path)
    return Run([path, grid_path], watch.seconds + seconds)


def decode(deltas, paths, folder):
    watch = Stopwatch()
    grid = stages.Grid.from_bytes(files.unpack(paths[1])[0])
    with tempfile.NamedTemporaryFile() as raw:
        seconds = run("decode", paths[0], raw.name)
        numbers = numpy.fromfile(raw.name, dtype="<i4")
    V, F, T = numbers[:3]
    levels = numbers[3 + 3 * T:].reshape(F, V, 3)
    with watch.running():
        positions = grid.values(numpy.cumsum(levels, axis=0, dtype=numpy.int32) if deltas else levels)
    return Run(files.give_back(folder, positions, numbers[3:3 + 3 * T].reshape(T, 3)), watch.seconds + seconds)


def peer(name, title, deltas, what):
    return Peer(
        name=name, title=title, source="Debian libdraco-dev (dpkg -s libdraco-dev)", missing=missing,
        counts=f"one .drc file: Edgebreaker's connectivity once, {what} quantised together as integer attributes, every vertex's "
               "number (Draco orders vertices anew); the grid",
        ladder=tuple({"bits": bits} for bits in range(8, 17)), promise=stages.Grid.promise,
        encode=lambda clip, setting, folder: encode(deltas, clip, setting, folder),
        decode=lambda paths, folder: decode(deltas, paths, folder))


PEERS = (peer("draco-frames", "Draco, frames as attributes", False, "all frames"),
         peer("draco-deltas", "Draco, deltas as attributes", True, "the first frame and the differences of frames"))
