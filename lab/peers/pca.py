"""Principal components of trajectories by hand: coefficients in Draco on the mesh, the basis under zstd. No entropy coder of ours."""
# SPDX-License-Identifier: MIT
import os
import struct

import numpy

from . import exchange, files, stages
from .draco import PROGRAM
from .peer import Peer, Run, Stopwatch


def principal(positions, share):
    """Mean [3F], basis [3F x K], coefficients [V x K], and the step of coefficients: of the percentage (KG) asked for, half of
    its square goes to what is left out and half to rounding."""
    D = numpy.asarray(positions, dtype=numpy.float64).transpose(0, 2, 1).reshape(-1, positions.shape[1])
    mean = D.mean(axis=1)
    D = D - mean[:, None]
    squares, vectors = numpy.linalg.eigh(D @ D.T)
    allowed = (share / 100) ** 2 * squares.sum() / 2
    K = max(1, int((numpy.cumsum(numpy.maximum(squares, 0)) > allowed).sum()))
    basis = vectors[:, ::-1][:, :K]
    return mean, basis, D.T @ basis, numpy.sqrt(12 * allowed / (K * D.shape[1]))


def rounded(basis, coefficients, step):
    """Levels of the basis, a step a component as fine as its coefficients are large, and those steps."""
    steps = (2 * step / numpy.linalg.norm(coefficients, axis=0)).astype(numpy.float32)
    return numpy.rint(basis / steps).astype(numpy.int32), steps


def in_time(levels, F):
    """[3F x K] as second differences along the frames, in byte planes under zstd."""
    curves = levels.reshape(F, -1)
    return stages.zstd_pack(stages.planes(stages.folded(numpy.diff(curves, n=2, axis=0, prepend=numpy.zeros((2, curves.shape[1]), int)).T)))


def from_time(packed, F, K):
    bends = stages.unfolded(stages.from_planes(stages.zstd_unpack(packed), 3 * F * K)).reshape(3 * K, F).T
    return numpy.cumsum(numpy.cumsum(bends, axis=0), axis=0).reshape(3 * F, K)


def encode(clip, setting, folder):
    watch, coded, head = Stopwatch(), os.path.join(folder, "coefficients.drc"), os.path.join(folder, "basis.bin")
    positions = numpy.asarray(clip.positions)
    with watch.running():
        mean, basis, coefficients, step = principal(positions, setting["share"])
        levels, steps = rounded(basis, coefficients, step)
        K = levels.shape[1]
        triples = numpy.pad(numpy.rint(coefficients / step).astype(numpy.int32), ((0, 0), (0, -K % 3)))
        parts = [struct.pack("<2If", clip.F, K, step), steps.tobytes() + mean.astype("<f4").tobytes(), in_time(levels, clip.F)]
    files.pack(head, parts)
    triples = triples.reshape(clip.V, -1, 3).swapaxes(0, 1)
    seconds = exchange.feed([exchange.built(PROGRAM), "encode"], coded, clip.triangles, triples)
    return Run([coded, head], watch.seconds + seconds)


def decode(paths, folder):
    watch = Stopwatch()
    counts, numbers, curves = files.unpack(paths[1])
    F, K, step = struct.unpack("<2If", counts)
    triangles, triples, seconds = exchange.fetch([exchange.built(PROGRAM), "decode"], paths[0])
    with watch.running():
        steps, mean = numpy.split(numpy.frombuffer(numbers, dtype="<f4"), [K])
        basis = (from_time(curves, F, K) * steps).astype(numpy.float32)
        coefficients = triples.swapaxes(0, 1).reshape(triples.shape[1], -1)[:, :K].astype(numpy.float32) * numpy.float32(step)
        positions = (basis @ coefficients.T + mean[:, None]).reshape(F, 3, -1).transpose(0, 2, 1)
    return Run(files.give_back(folder, positions, triangles), watch.seconds + seconds)


PEERS = (Peer(
    name="pca-draco", title="PCA by hand, coefficients in Draco", source="NumPy; Debian libdraco-dev (dpkg -s libdraco-dev), libzstd1",
    counts="one .drc file: connectivity, three coefficients an integer attribute, every vertex's number; the basis as second differences in "
           "time in byte planes under zstd -19; mean and steps as float32",
    ladder=tuple({"share": share} for share in (4.0, 2.0, 1.0, 0.5, 0.25, 0.12, 0.06)),
    missing=lambda: exchange.missing_program(PROGRAM), encode=encode, decode=decode),)
