"""A sequence as the lab and its peers see it: the paths of its mesh and its motion, their counts, their positions."""
# SPDX-License-Identifier: MIT
import os
import struct
from dataclasses import dataclass
from functools import cached_property

PC2_MAGIC = b"POINTCACHE2\0"
PC2_HEADER = struct.Struct("<12siiffi")  # magic, version, points, start, rate, samples


class ClipError(Exception):
    """Files that are no clip."""


@dataclass(frozen=True)
class Clip:
    """One animation: V vertices through F frames under T triangles."""
    name: str
    mesh: str    # path of an OBJ file: the connectivity, and the vertex order
    motion: str  # path of a PC2 file: V positions a frame, in that order

    @cached_property
    def counts(self):
        """V and F, as the head of the point cache says them."""
        with open(self.motion, "rb") as file:
            head = file.read(PC2_HEADER.size)
        if len(head) < PC2_HEADER.size or not head.startswith(PC2_MAGIC):
            raise ClipError(f"{self.motion}: no point cache (PC2)")
        _, _, vertices, _, _, frames = PC2_HEADER.unpack(head)
        if os.path.getsize(self.motion) != PC2_HEADER.size + 12 * vertices * frames:
            raise ClipError(f"{self.motion}: the head promises {frames} frames of {vertices} vertices, the file has another size")
        return vertices, frames

    V = property(lambda self: self.counts[0])
    F = property(lambda self: self.counts[1])
    T = property(lambda self: len(self.faces))

    @cached_property
    def faces(self):
        """Vertex numbers of the triangles, from 0; a face of more corners is a fan."""
        triangles = []
        with open(self.mesh, encoding="utf-8") as file:
            for line in file:
                if line.startswith("f "):
                    corners = [int(word.split("/")[0]) - 1 for word in line.split()[1:]]
                    triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
        return triangles

    @cached_property
    def triangles(self):
        """[T x 3] of int32."""
        import numpy
        return numpy.array(self.faces, dtype=numpy.int32).reshape(-1, 3)

    @cached_property
    def positions(self):
        """[F x V x 3] of float32, mapped from the file, not to be written to."""
        import numpy
        return numpy.memmap(self.motion, dtype="<f4", mode="r", offset=PC2_HEADER.size, shape=(self.F, self.V, 3))


def write_pc2(path, positions, rate=1.0):
    """Positions [F x V x 3] as a point cache."""
    import numpy
    frames, vertices, _ = positions.shape
    with open(path, "wb") as file:
        file.write(PC2_HEADER.pack(PC2_MAGIC, 1, vertices, 0.0, rate, frames))
        numpy.ascontiguousarray(positions, dtype="<f4").tofile(file)
