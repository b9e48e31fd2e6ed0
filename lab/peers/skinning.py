"""A skinning decomposition (ssdr.py) stored plainly: rest pose, at most four weights a vertex, rigid bones, 16 bits each."""
# SPDX-License-Identifier: MIT
import os
import struct

import numpy

from . import files, ssdr, stages
from .peer import Peer, PeerError, Run, Stopwatch

LEVELS = 2**16 - 1


def quaternions(turns):
    """(x, y, z, w) [F x B x 4] of rotations [F x B x 3 x 3], no sudden change of sign along F."""
    mixed = numpy.zeros((*turns.shape[:2], 4, 4))  # its dominant eigenvector is the quaternion (Bar-Itzhack 2000)
    mixed[..., :3, :3] = turns + turns.swapaxes(2, 3) - numpy.eye(3) * numpy.trace(turns, axis1=2, axis2=3)[..., None, None]
    twist = numpy.stack([turns[..., 2, 1] - turns[..., 1, 2], turns[..., 0, 2] - turns[..., 2, 0], turns[..., 1, 0] - turns[..., 0, 1]], axis=-1)
    mixed[..., 3, :3] = mixed[..., :3, 3] = twist
    mixed[..., 3, 3] = numpy.trace(turns, axis1=2, axis2=3)
    found = numpy.linalg.eigh(mixed)[1][..., -1]
    turn_over = numpy.concatenate([numpy.ones((1, turns.shape[1])), numpy.sign((found[1:] * found[:-1]).sum(axis=2))])
    return found * numpy.cumprod(numpy.where(turn_over == 0, 1, turn_over), axis=0)[:, :, None]


def rotations(quaternions):
    x, y, z, w = numpy.moveaxis(quaternions / numpy.linalg.norm(quaternions, axis=2, keepdims=True), 2, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return numpy.moveaxis(numpy.array(rows), (0, 1), (2, 3))


def in_time(numbers):
    """[F x ...] as differences from frame to frame, each number's after each other, in byte planes."""
    deltas = numpy.diff(numbers.reshape(len(numbers), -1), axis=0, prepend=0)
    return stages.zstd_pack(stages.planes(stages.folded(deltas.T)))


def from_time(packed, F, width):
    deltas = stages.unfolded(stages.from_planes(stages.zstd_unpack(packed), F * width)).reshape(width, F)
    return numpy.cumsum(deltas, axis=1).T


def joints(skin):
    """Where each bone sits in the rest pose [B x 3]: among its vertices, so that its path is as calm as theirs."""
    sums = numpy.zeros((len(skin.transforms), 4))
    numpy.add.at(sums, skin.bones.reshape(-1), skin.weights.reshape(-1, 1) * numpy.repeat(ssdr.homogeneous(skin.rest).T, ssdr.INFLUENCES, axis=0))
    return (sums[:, :3] / numpy.maximum(sums[:, 3:], 1e-30)).astype(numpy.float32)


def parts_of(skin):
    """Everything but the triangles."""
    rest_grid, seats = stages.Grid.around(skin.rest, 16), joints(skin)
    turns, shifts = skin.transforms[..., :3].swapaxes(0, 1), skin.transforms[..., 3].swapaxes(0, 1)  # [F x B ...]
    paths = numpy.einsum("fbij,bj->fbi", turns, seats) + shifts
    path_grid = stages.Grid.around(paths, 16)
    order = numpy.argsort(-skin.weights, axis=1, kind="stable")  # the largest weight is 1 less the others
    bones = numpy.take_along_axis(skin.bones, order, axis=1)
    levels = numpy.rint(numpy.take_along_axis(skin.weights, order, axis=1)[:, 1:] * LEVELS).astype(numpy.uint32)
    bones[:, 1:][levels == 0] = 0
    rest = numpy.diff(rest_grid.levels(skin.rest), axis=0, prepend=0)
    return [rest_grid.bytes() + path_grid.bytes() + seats.tobytes(), stages.zstd_pack(stages.planes(stages.folded(rest.T))),
            stages.zstd_pack(stages.planes(bones.astype(numpy.uint32).T)), stages.zstd_pack(stages.planes(levels.T)),
            in_time(numpy.rint(quaternions(turns) * 32767).astype(numpy.int32)), in_time(path_grid.levels(paths))]


def skin_of(parts, V, F, B):
    head, rest, bones, levels, turns, paths = parts
    rest_grid, path_grid = stages.Grid.from_bytes(head[:32]), stages.Grid.from_bytes(head[32:64])
    seats = numpy.frombuffer(head[64:], dtype="<f4").reshape(B, 3).astype(numpy.float64)
    numbers = [stages.from_planes(stages.zstd_unpack(part), width * V).reshape(width, V) for part, width in ((rest, 3), (bones, 4), (levels, 3))]
    others = numbers[2].T / LEVELS
    turns = rotations(from_time(turns, F, 4 * B).reshape(F, B, 4))
    paths = path_grid.values(from_time(paths, F, 3 * B).reshape(F, B, 3))
    transforms = numpy.concatenate([turns, (paths - numpy.einsum("fbij,bj->fbi", turns, seats))[..., None]], axis=3)
    if numbers[1].max() >= B:
        raise PeerError(f"a weight for bone {numbers[1].max()} of {B}")
    return ssdr.Skin(rest_grid.values(numpy.cumsum(stages.unfolded(numbers[0]), axis=1).T).astype(numpy.float64),
                     transforms.swapaxes(0, 1), numbers[1].T.astype(numpy.int64),
                     numpy.concatenate([1 - others.sum(axis=1, keepdims=True), others], axis=1))


def encode(clip, setting, folder):
    watch, path = Stopwatch(), os.path.join(folder, "clip.bin")
    positions = numpy.asarray(clip.positions)
    with watch.running():
        skin = ssdr.decompose(positions, setting["bones"])
        parts = [*parts_of(skin), stages.zstd_pack(stages.triangle_planes(clip.triangles))]
    files.pack(path, [struct.pack("<4I", clip.V, clip.F, clip.T, len(skin.transforms)), *parts])
    return Run([path], watch.seconds)


def decode(paths, folder):
    watch = Stopwatch()
    head, *parts, triangles = files.unpack(paths[0])
    V, F, T, B = struct.unpack("<4I", head)
    with watch.running():
        positions = ssdr.posed(skin_of(parts, V, F, B)).reshape(F, 3, V).transpose(0, 2, 1).astype(numpy.float32)
        triangles = stages.triangles_from_planes(stages.zstd_unpack(triangles), T)
    return Run(files.give_back(folder, positions, triangles), watch.seconds)


PEERS = (Peer(
    name="skinning", title="skinning decomposition + zstd", source="lab/peers/ssdr.py, after Le and Deng (2012); Debian libzstd1",
    counts="rest pose, four bone numbers and three weights a vertex, a quaternion and a place a bone and frame, 16 bits each (bone numbers: "
           "8), as differences in byte planes under zstd -19; triangles likewise",
    ladder=tuple({"bones": bones} for bones in (4, 8, 16, 32, 64)),
    missing=lambda: stages.missing_library("zstd", "libzstd1"), encode=encode, decode=decode),)
