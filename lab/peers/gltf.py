"""glTF through gltfpack: one morph target a frame, or principal components as morph targets; decoded as a viewer would."""
# SPDX-License-Identifier: MIT
import os
import tempfile

import numpy

from . import exchange, files, glb, stages
from .peer import Peer, Run, Stopwatch

SCRIPT = "gltf.mjs"


def encode(document, options, zipped, folder):
    """Packs a GLB file; under zstd where it is sent so."""
    path = os.path.join(folder, "clip.glb" + (".zst" if zipped else ""))
    with tempfile.NamedTemporaryFile() as plain, tempfile.NamedTemporaryFile() as packed:
        plain.write(document)
        plain.flush()
        seconds = exchange.run(*exchange.script(SCRIPT, "encode", *options, "-af", "0"), plain.name, packed.name)
        with open(packed.name, "rb") as file:
            raw = file.read()
    watch = Stopwatch()
    with watch.running():
        raw = stages.zstd_pack(raw) if zipped else raw
    with open(path, "wb") as file:
        file.write(raw)
    return Run([path], watch.seconds + seconds)


def decode(paths, folder):
    watch = Stopwatch()
    with open(paths[0], "rb") as file:
        raw = file.read()
    with watch.running():
        raw = stages.zstd_unpack(raw) if paths[0].endswith(".zst") else raw
    with tempfile.NamedTemporaryFile() as plain:
        plain.write(raw)
        plain.flush()
        triangles, positions, seconds = exchange.fetch(exchange.script(SCRIPT, "decode"), plain.name, "<f4")
    return Run(files.give_back(folder, positions, triangles), watch.seconds + seconds)


def frames(clip):
    positions = numpy.asarray(clip.positions)
    return glb.build(clip.triangles, positions[0], positions[1:] - positions[0], numpy.eye(clip.F)[:, 1:])


STEPS = 255  # gltfpack keeps weights as 8 bits from 0 to 1


def principal(centred, whole, share):
    """Components [K x 3V], weights [F x K]: until what is left is so many percent of the whole."""
    squares, vectors = numpy.linalg.eigh(centred @ centred.T)  # F x F, ascending
    left = numpy.cumsum(numpy.maximum(squares, 0))  # what is lost without this component and all smaller ones
    count = max(1, int((numpy.sqrt(left / whole) * 100 > share).sum()))
    weights = vectors[:, ::-1][:, :count]
    return weights.T @ centred, weights


def refined(targets, weights, whole, share):
    """Weights of eight bits are too coarse for large components: those get a second target, a step of the first in length,
    until rounding costs a third of the share."""
    noise = len(weights) * numpy.square(targets).sum(axis=1) / 12 / STEPS**2 / whole * 1e4
    noise_left = numpy.cumsum(noise[::-1])[::-1]  # of this component and all smaller ones: they are sorted nearly so
    fine = int((noise_left > (share / 3)**2).sum())
    coarse = weights.copy()
    coarse[:, :fine] = numpy.minimum(numpy.floor(weights[:, :fine] * STEPS), STEPS - 1) / STEPS
    rest = (weights - coarse)[:, :fine] * STEPS
    return numpy.concatenate([targets, targets[:fine] / STEPS]), numpy.concatenate([coarse, rest], axis=1)


def components(clip, share):
    """Principal components of trajectories until so many percent (KG) are left. The base is where each weight is least, a
    target spans all that its component does."""
    watch = Stopwatch()
    positions = numpy.asarray(clip.positions, dtype=numpy.float64)
    with watch.running():
        flat = positions.reshape(clip.F, -1)
        mean = flat.mean(axis=0)
        whole = numpy.square(positions - positions.mean(axis=1, keepdims=True)).sum()
        targets, weights = principal(flat - mean, whole, share)
        low, span = weights.min(axis=0), numpy.maximum(numpy.ptp(weights, axis=0), 1e-30)
        base = (mean + low @ targets).reshape(-1, 3)
        targets, weights = refined(targets * span[:, None], (weights - low) / span, whole, share)
        document = glb.build(clip.triangles, base, targets.reshape(len(targets), -1, 3), weights)
    return document, watch.seconds


def encode_frames(option, zipped):
    return lambda clip, setting, folder: encode(frames(clip), [option, "-vp", str(setting["bits"])], zipped, folder)


def encode_components(clip, setting, folder):
    document, seconds = components(clip, setting["share"])
    done = encode(document, ["-cz", "-vp", str(setting["bits"])], True, folder)
    return Run(done.files, done.seconds + seconds)


SAME = {"source": "npm gltfpack and meshoptimizer (lab/peers/package.json)", "missing": lambda: exchange.missing_package("gltfpack"),
        "decode": decode}
INSIDE = "targets, weights, triangles, and each vertex's number as _ID (gltfpack orders vertices anew)"


def frames_peer(option, zipped):
    under = " + zstd" if zipped else ""
    return Peer(name=f"gltfpack{option}", title=f"gltfpack {option}, a target a frame{under}", **SAME,
                counts=f"one GLB file {'under zstd -19' if zipped else 'as it is'}: {INSIDE}",
                ladder=tuple({"bits": bits} for bits in (8, 9, 10, 12, 14, 16)), encode=encode_frames(option, zipped))


PEERS = (frames_peer("-c", False), frames_peer("-cc", True), frames_peer("-cz", True),
         Peer(name="gltfpack-pca", title="gltfpack -cz, PCA targets + zstd", **SAME,
              counts=f"one GLB file under zstd -19: {INSIDE}; large components have a second, fine target, because gltfpack keeps weights as 8 bits",
              ladder=tuple({"share": share, "bits": bits} for share, bits in
                           ((4, 10), (2, 10), (1, 11), (0.5, 12), (0.25, 13), (0.12, 14), (0.06, 15))),
              encode=encode_components))
